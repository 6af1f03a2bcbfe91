// From two gray views to raw disparities of both: cost, aggregation, winner-take-all, sub-pixel.
#pragma once

#include <cstdint>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "pomona/options.h"
#include "sgm/aggregation.h"
#include "sgm/cost.h"

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
  int prior_shift_px = 0;  ///< what disparities of the prior are larger by, for views that lack columns
};

/// The columns of either view that have a partner in the other at some disparity of a range: `width` of them,
/// in the left view from `left` on, in the right view from `right` on.
struct PartnerColumns {
  int left, right, width;

  /// `width`: of the views; the range leads from some column of one to some of the other.
  static PartnerColumns of(int width, int min_disparity, int disparities);
  /// By how much disparities are smaller in views of these columns alone.
  int shiftPx() const { return left - right; }
};

/// Unvalidated disparities, pixels, of the image's size.
struct MatchMaps {
  Image<float> disparity;        ///< of the left view; NaN where it is out of range
  Image<float> right_disparity;  ///< of the right view; NaN where no left pixel maps to
  Image<std::uint8_t> state;     ///< PixelState: measured, ambiguous where uniqueness fails, or out of range
  /// Rows of what tells how clearly the winner won, of the path sums S: the lowest more than one disparity
  /// away less S(d), large if there is none;
  std::uint16_t* margin(int y) { return scores.row(y); }
  const std::uint16_t* margin(int y) const { return scores.row(y); }
  /// and how sharply: S(d - 1) + S(d + 1) - 2 S(d).
  std::uint16_t* curvature(int y) { return scores.row(y) + disparity.width(); }
  const std::uint16_t* curvature(int y) const { return scores.row(y) + disparity.width(); }

  Image<std::uint16_t> scores;  ///< the two above, side by side

  void resize(int width, int height);
};

/// The curve of SubpixelMethod::kFitted, as bench/subpixel fits it to the sums of 4 paths, and to those of 8
/// if it has no cubic term (docs/algorithms.md says why).
SubpixelCurve subpixelCurve(int paths);

/// Row y of the maps, which have their size, from the winners of `columns` of it, whose disparities begin
/// with options.min_disparity. All other pixels are out of range.
void finishRow(const WinnerRow& winners, int y, const PartnerColumns& columns, const MatchOptions& options,
               const SgmKernels& kernels, MatchMaps& out);

class SgmMatcher {
 public:
  /// `table`: for kMutualInformation, the cost of every pair of 8-bit values (see mutual_information.h).
  void match(const MatchInput& pair, const MatchOptions& options, std::span<const std::uint8_t> table,
             const SgmKernels& kernels, MatchMaps& out, Arena& scratch, int threads);

  /// The same up to the winners of each row, for whoever wants to look at the sums behind a match.
  void findWinners(const MatchInput& pair, const MatchOptions& options, std::span<const std::uint8_t> table,
                   const SgmKernels& kernels, WinnerSink sink, Arena& scratch, int threads);

 private:
  MatchingCostRows cost_;
};

}  // namespace pomona
