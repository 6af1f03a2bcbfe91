// The sparse map of one pair at one scale: matching and every check that removes pixels.
#pragma once

#include <cstdint>
#include <span>

#include "core/image.h"
#include "engine/stage_clock.h"
#include "filters/kernels.h"
#include "filters/left_right.h"
#include "filters/median.h"
#include "filters/speckle.h"
#include "sgm/matcher.h"

namespace pomona {

/// Rows [y, y + height) of the frame, to be searched for the disparities [min_disparity, min_disparity +
/// disparities).
struct SearchBand {
  int y, height;
  int min_disparity, disparities;

  /// Rows above and below that are matched as well, so that the paths do not start at the band's border.
  static constexpr int kMargin_px = 32;
};

class SparseStage {
 public:
  struct Settings {
    MatchOptions match;
    ValidationOptions validation;
    std::span<const std::uint8_t> mutual_information;  ///< cost table where the cost asks for one
    ImageView<const std::uint8_t> mask;                ///< empty, or 0 where a pixel is excluded
    Isa isa;
    int threads;
  };

  /// Afterwards maps() holds the validated map: NaN with a reason wherever the state is not measured.
  /// `bands`: none, or bands that cover the frame once; each keeps to its range instead of that of
  /// `settings`.
  void run(const MatchInput& pair, const Settings& settings, StageClock& clock,
           std::span<const SearchBand> bands = {});

  MatchMaps& maps() { return maps_; }
  const MatchMaps& maps() const { return maps_; }

 private:
  void matchBand(const MatchInput& pair, const Settings& settings, const SearchBand& band);

  SgmMatcher matcher_;
  MatchMaps maps_;
  LeftRightScratch left_right_;
  SpeckleScratch speckle_;
  MedianScratch median_;
};

/// The options for the same pair `ratio` times smaller (`width` columns wide): the range shrinks with it.
MatchOptions scaledOptions(const MatchOptions& full, double ratio, int width);

}  // namespace pomona
