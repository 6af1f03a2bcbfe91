// From two gray views to raw disparities of both: cost, aggregation, winner-take-all, sub-pixel.
#pragma once

#include <cstdint>
#include <span>

#include "core/image.h"
#include "pomona/options.h"
#include "sgm/aggregation.h"
#include "sgm/census.h"
#include "sgm/color_steps.h"
#include "sgm/cost.h"
#include "sgm/sobel.h"

namespace pomona {

/// A rectified pair. The 8-bit gray views are always there; where the 16-bit ones are, census uses them
/// instead.
struct MatchInput {
  ImageView<const std::uint8_t> left, right;
  ImageView<const std::uint16_t> left16, right16;
  GuideView guide;  ///< the left view with its colours: steers penalties and supports

  ImageView<const float> prior = {};  ///< empty, or disparities to be drawn to
};

struct MatchOptions {
  int min_disparity = 0;
  int disparities = 64;
  CostOptions cost;
  AggregationOptions aggregation;
  WinnerOptions winner;
  MemoryMode memory = MemoryMode::kAutomatic;
  // See MatchingCostRows::preparePrior; used with MatchInput::prior.
  int prior_weight = 0;
  int prior_reach_px = 0;
};

/// Unvalidated disparities, pixels, of the image's size.
struct MatchMaps {
  Image<float> disparity;        ///< of the left view; never NaN
  Image<float> right_disparity;  ///< of the right view; NaN where no left pixel maps to
  /// Of the path sums S: how clearly the winner won, the lowest more than one disparity away less S(d),
  /// large if there is none; and how sharply, S(d - 1) + S(d + 1) - 2 S(d).
  Image<std::uint16_t> margin, curvature;
  Image<std::uint8_t> state;  ///< PixelState: measured, or ambiguous where uniqueness fails

  void resize(int width, int height);
};

/// Row y of the maps, which have their size, from its winners.
void finishRow(const WinnerRow& winners, int y, const MatchOptions& options, const SgmKernels& kernels,
               MatchMaps& out);

class SgmMatcher {
 public:
  /// `table`: for kMutualInformation, the cost of every pair of 8-bit values (see mutual_information.h).
  void match(const MatchInput& pair, const MatchOptions& options, std::span<const std::uint8_t> table,
             const SgmKernels& kernels, MatchMaps& out, int threads);

  /// The same up to the winners of each row, for whoever wants to look at the sums behind a match.
  void findWinners(const MatchInput& pair, const MatchOptions& options, std::span<const std::uint8_t> table,
                   const SgmKernels& kernels, WinnerSink sink, int threads);

 private:
  struct View {
    CensusPlanes census;
    Image<std::uint8_t> sobel;
  };
  MatchingCostRows::Features extract(ImageView<const std::uint8_t> gray,
                                     ImageView<const std::uint16_t> gray16, MatchingCost cost, View& view,
                                     const SgmKernels& kernels, int threads);

  CensusTransform<std::uint8_t> census_;
  CensusTransform<std::uint16_t> census16_;
  SobelFilter sobel_;
  View left_, right_;
  ColorSteps steps_;
  MatchingCostRows cost_;
  Aggregator aggregator_;
};

}  // namespace pomona
