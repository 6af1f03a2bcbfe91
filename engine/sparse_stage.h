// The sparse map of one pair at one scale: matching and every check that removes pixels.
#pragma once

#include <cstdint>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "engine/stage_clock.h"
#include "sgm/matcher.h"

namespace pomona {

class SparseStage {
 public:
  struct Settings {
    MatchOptions match;
    ValidationOptions validation;
    std::span<const std::uint8_t> mutual_information;  ///< cost table where the cost asks for one
    ImageView<const std::uint8_t> mask;                ///< empty, or 0 where a pixel is excluded
    Isa isa;
    int threads;
    Arena* scratch;  ///< for whatever a stage needs only while it runs
  };

  /// Afterwards maps() holds the validated map: NaN with a reason wherever the state is not measured.
  void run(const MatchInput& pair, const Settings& settings, StageClock& clock);

  MatchMaps& maps() { return maps_; }

 private:
  SgmMatcher matcher_;
  MatchMaps maps_;
};

/// The options for the same pair `ratio` times smaller (`width` columns wide): the range shrinks with it.
MatchOptions scaledOptions(const MatchOptions& full, double ratio, int width);

}  // namespace pomona
