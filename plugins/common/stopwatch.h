// Wall-clock times for a result's figures.
#pragma once

#include <chrono>

namespace pomona {

class Stopwatch {
 public:
  /// Milliseconds since the last lap, or since it was made.
  double lapMs() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pomona
