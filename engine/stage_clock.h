// Wall-clock time per stage.
#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "pomona/disparity.h"

namespace pomona {

/// Each lap() charges the time since the last one to a stage. A default-made clock keeps nothing: for work
/// whose caller charges it as a whole.
class StageClock {
 public:
  StageClock() = default;
  explicit StageClock(std::vector<StageTiming>& timings) : timings_(&timings) { timings.clear(); }

  /// `stage` must be static text.
  void lap(std::string_view stage) {
    if (!timings_) return;
    const auto now = std::chrono::steady_clock::now();
    timings_->push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

 private:
  std::vector<StageTiming>* timings_ = nullptr;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pomona
