// The row and block kernels of the filters, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pomona {

enum class Isa;  // core/cpu.h; kernel files must not see the standard headers it includes

/// Output pixels of one call of `jointBilateral`, on every instruction set.
inline constexpr int kBilateralBlock = 16;

/// What the pixels of one block are averaged over. The pointers aim at the block's first pixel; rows y -
/// radius to y + radius are read, in each of them x - radius to x + radius + kBilateralBlock - 1.
struct BilateralWindow {
  const float* disparity;  ///< 0 where unknown
  const float* guide[3];   ///< one plane per channel; +infinity in the first where the disparity is unknown
  const float* centre;     ///< the first channel without these infinities
  std::ptrdiff_t stride;   ///< of all planes, in elements
  int channels;            ///< 1 or 3
  int radius;
  const float* log_weight;  ///< (2 radius + 1)^2 binary logarithms of the spatial weight, row by row, <= 0
  float range_scale;  ///< log2 of the range weight per unit of the summed squared difference, negated; > 0
};

/// Below this sum of weights a pixel counts as having no neighbour, and stays unknown.
inline constexpr float kMinimumBilateralWeight = 1e-20f;

/// One row of a disparity map and its guide, from which the rows above and below can be reached, and pixels
/// left and right of the image: see filters/guided_plane.h.
struct GuidedRow {
  const float* disparity;
  const std::uint32_t* color;
  std::ptrdiff_t stride;  ///< of both, in elements
};

/// Of filters/median.h.
inline constexpr int kMedianOverrun = 18;

/// The window of filters/weighted_median.h, in reading order.
struct MedianWindow {
  static constexpr int kRadius = 5;
  static constexpr int kTaps = 61;  ///< every other pixel of 11 x 11

  std::int32_t offset[kTaps];  ///< from the pixel, in elements
  float log_weight[kTaps];     ///< binary logarithm of the spatial weight, <= 0
  float color_scale;           ///< taken from it per unit of the colour difference, summed over the channels
};

/// Of filters/plane_refine.h.
inline constexpr float kPlaneDisparityTolerance_px = 1.0f;
inline constexpr std::uint8_t kPlaneColorTolerance = 15;
inline constexpr float kPlaneFewestTaps = 6.0f;
inline constexpr float kPlaneRidge = 0.3f;

/// Pixels are matched so many at a time, in memory that the first-level cache holds.
inline constexpr int kMatchChunk = 256;

/// `count` pixels of a row from x_begin on, at most kMatchChunk; `right` is the whole row of the right map.
struct MatchedPixels {
  const float* disparity;
  const float* right;
  int x_begin, count, width;
};

/// One row of filters/left_right.h, and what becomes of the states. It searches at most
/// kMostCheckedDisparities.
struct LeftRightRow {
  int width, min_disparity, max_disparity;
  float threshold_px, tolerance_px;  ///< tolerance_px >= 1: two neighbouring columns are within it
  const float* right;
  float* disparity;                                           ///< in and out
  std::uint8_t* state;                                        ///< in and out
  std::uint8_t measured, out_of_range, mismatched, occluded;  ///< values of it
};
inline constexpr int kMostCheckedDisparities = 1024;
/// Disparities of this size or more, as infinite ones, meet nothing.
inline constexpr float kFarthestDisparity_px = 1e9f;

/// Of engine/trust.h.
inline constexpr int kTrustSteps = 16;
inline constexpr int kTrustCodes = kTrustSteps * kTrustSteps * kTrustSteps;
struct TrustPixels {
  MatchedPixels match;
  const std::uint16_t *margin, *curvature;
  float scale;  ///< from these to their steps
};
struct TrustPair {
  float confidence, sigma_px;
};

/// Pixels of a row, from `begin` to the next run of the row, whose neighbours differ by at most the step; or
/// that are all unknown. A node of a forest, a tree per component.
struct SpeckleRun {
  std::int32_t begin;
  /// Of a root, the pixels of the component, negated; -enough_px also for more, after which components may
  /// stay apart, and for unknown pixels. Of others, a run nearer to the root.
  std::int32_t link;
};
struct SpeckleRow {
  const float* disparity;
  const std::uint64_t* breaks;  ///< bit x % 64 of word x / 64: a run other than the row's first begins at x
  int first;                    ///< index of the row's first run
};

struct FilterKernels {
  void (*leftRight)(const LeftRightRow&);
  /// codes[i] = (margin step * kTrustSteps + curvature step) * kTrustSteps + residual step; the residual's
  /// are eighths of a pixel of |d - d_right| at the match; the last one of each is open upwards. The first
  /// step of the margin is cut in two: 0 is its lower half, 1 its upper.
  void (*trustCodes)(const TrustPixels& pixels, std::uint16_t* codes);
  /// The pairs of `count` pixels, at most kMatchChunk: of_code[code] where the state is `measured`,
  /// of_code[kTrustCodes + state] elsewhere.
  void (*trustPairs)(const TrustPair* of_code, const std::uint16_t* codes, const std::uint8_t* state,
                     std::uint8_t measured, int count, float* confidence, float* sigma_px);
  /// Cuts a row into `runs`, filters/speckle.h, and sets its `breaks`; returns how many there are.
  int (*findRuns)(const float* row, int width, float max_step_px, int enough_px, std::uint64_t* breaks,
                  SpeckleRun* runs);
  /// Unites the runs of two neighbouring rows that are connected somewhere.
  void (*uniteRuns)(const SpeckleRow& above, const SpeckleRow& below, int width, float max_step_px,
                    int enough_px, SpeckleRun* runs);
  /// One row of the NaN-aware median, see filters/median.h. `rows` are the 3 (5) input rows around it,
  /// readable from 1 (2) pixels before their start to kMedianOverrun pixels after their end.
  void (*median3x3)(const float* const* rows, int width, float* out);
  void (*median5x5)(const float* const* rows, int width, float* out);
  /// kBilateralBlock pixels of the joint bilateral filter, NaN where unknown, see filters/joint_bilateral.h.
  void (*jointBilateral)(const BilateralWindow& window, float* out);
  /// near[x] = 1 if pixel x is known and a known pixel of the 3 x 3 around it differs by more than
  /// `threshold_px`, else 0.
  void (*nearJumps)(const GuidedRow& row, int width, float threshold_px, std::uint8_t* near);
  /// out[x] = the weighted median around x, for the `count` known pixels whose columns x are given.
  void (*weightedMedian)(const GuidedRow& row, const MedianWindow& window, const std::int32_t* columns,
                         int count, float* out);
  /// One row of filters/plane_refine.h, for a window radius of 2 and of 3.
  void (*refinePlanes[2])(const GuidedRow& row, int width, float* out);
};

/// `isa` must be one of usableIsas().
const FilterKernels& filterKernels(Isa isa);

}  // namespace pomona
