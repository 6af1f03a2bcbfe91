// The inner loops of scaling, pyramids, segments and hole filling, one table of them per instruction set.
//
// Every table gives the same bytes: integer sums are exact, float expressions are evaluated per element in
// the order written here, and nothing is contracted. Rows need no alignment and may have any length >= 0.
#pragma once

#include <cstdint>

namespace pomona {

enum class Isa;

/// Directions in which a hole looks for what may fill it.
constexpr int kHoleRays = 4;
/// Most holes that one call of a kernel takes.
constexpr int kHoleBatch = 64;

/// Values of the state, see findHoles and countSourcesAndHoles.
struct HoleStates {
  std::uint8_t measured, plane, missing, masked;
};

/// What the candidates of one ray are read from. Strides count elements; stride * height must be below 2^31.
struct CandidateSources {
  const float* disparity;
  std::int32_t disparity_stride;
  const float* right_disparity;
  std::int32_t right_stride;
  const std::uint8_t* guide;  ///< 1 or 3 `channels` side by side
  std::int32_t guide_stride, channels;
  std::int32_t width;
  float visibility_tolerance_px;
  const std::uint32_t* color_weight;     ///< by the sum of absolute differences of the bytes; below 2^16
  const std::uint32_t* distance_weight;  ///< by the number of steps; below 2^16
  std::int32_t dx, dy;                   ///< the ray's step
};

/// The disparity a (x - x0) + b (y - y0) + c, kept within low and high; none if c is NaN.
struct SegmentPlane {
  float a = 0, b = 0, c = 0, low = 0, high = 0;
  std::int32_t x0 = 0, y0 = 0;
  std::int32_t unused = 0;  // planes are read as 8 words each
};

/// Most holes that one call of planeDisparities takes.
constexpr int kPlaneBatch = 256;

/// What the holes of a row are filled with, see pyramid/plane_fill.h.
struct PlaneFillRow {
  const SegmentPlane* planes;
  const float* right_disparity;
  std::int32_t width, y;
  float min_disparity, max_disparity, visibility_tolerance_px, border_tolerance_px;
  /// Holes left of left_x and right of right_x lie beyond the right view: at these columns, their planes must
  /// be within the tolerance of these disparities.
  std::int32_t left_x, right_x;
  float beyond_left_px, beyond_right_px;
};

struct PyramidKernels {
  /// sum[i] += weight * in[i]
  void (*accumulate8)(const std::uint8_t* in, std::uint32_t weight, int n, std::uint32_t* sum);
  void (*accumulate16)(const std::uint16_t* in, std::uint32_t weight, int n, std::uint32_t* sum);

  /// out[x] = sum over k of weight[k n + x] * in[index[k n + x]], k = 0..3
  void (*cubicRow)(const float* in, const std::int32_t* index, const float* weight, int n, float* out);
  /// out[x] = sum over k of weight[k] * rows[k][x]
  void (*cubicColumn)(const float* const rows[4], const float weight[4], int n, float* out);

  /// Every second sample of `in` (n of them) after [1 4 6 4 1]/16, both ends replicated; writes (n + 1) / 2.
  void (*reduceRow)(const float* in, int n, float* out);
  /// out = (rows[0] + 4 rows[1] + 6 rows[2] + 4 rows[3] + rows[4]) / 16
  void (*reduceColumn)(const float* const rows[5], int n, float* out);
  /// The (n + 1) / 2 samples of `in` at twice their rate: [1 6 1]/8 at even, [1 1]/2 at odd places; writes n.
  void (*expandRow)(const float* in, int n, float* out);
  /// inout += side_weight * (above + below) + middle_weight * middle
  void (*addExpandedColumn)(const float* above, const float* middle, const float* below, float side_weight,
                            float middle_weight, int n, float* inout);

  /// inout = (inout + other) / 2
  void (*average)(const float* other, int n, float* inout);

  /// open[x] = 0 for sources: of state `measured` with a disparity that is not NaN, or of state `plane`; else
  /// 0xffff. is_hole[x] = 1 if pixel x is `measured` but NaN, or at least `missing` but not `masked`; else 0.
  /// Returns how many holes there are.
  int (*findHoles)(const float* disparity, const std::uint8_t* state, HoleStates states, int n,
                   std::uint16_t* open, std::uint8_t* is_hole);
  /// One step along a ray: steps = open & saturating(steps + 1); `open` as above.
  void (*advanceRays)(const std::uint16_t* open, int n, std::uint16_t* steps);

  /// out[i] = |a[i] - b[i]|
  void (*difference1)(const std::uint8_t* a, const std::uint8_t* b, int n, std::uint8_t* out);
  /// The same for pixels of three interleaved channels: the largest of their differences.
  void (*largestDifference3)(const std::uint8_t* a, const std::uint8_t* b, int n, std::uint8_t* out);
  /// sums[i] += 1 if state[i] is `measured` and disparity[i] not NaN; += 256 if it is `measured` but NaN, or
  /// at least `missing` but not `masked`.
  void (*countSourcesAndHoles)(const float* disparity, const std::uint8_t* state, HoleStates states, int n,
                               std::uint16_t* sums);
  /// How many of n points have |((a x + b y) + c) - d| < tolerance.
  int (*countNearPlane)(const float* x, const float* y, const float* d, int n, float a, float b, float c,
                        float tolerance);

  /// out[i] = the disparity of planes[segment[i]] at column x[i], NaN if it may not be there; n <=
  /// kPlaneBatch. The arrays have room for kPlaneBatch values, all of them valid places.
  void (*planeDisparities)(const PlaneFillRow& row, const std::int32_t* x, const std::int32_t* segment, int n,
                           float* out);

  /// out[x] = 25 rows[2][x] less the sum of the 5 x 5 pixels around it, columns beyond the ends being the
  /// last ones; 0 if that is beyond +- limit, which is at most 127.
  void (*localResidual)(const std::uint8_t* const rows[5], int n, int limit, std::int8_t* out);
  /// For every k in 0 .. places - 1, over the i < n with left[i] != 0:
  /// products[k] += left[i] * right[i + k], squares[k] += right[i + k]^2. Values are within +-90.
  void (*correlate)(const std::int8_t* left, const std::int8_t* right, int n, int places,
                    std::int32_t* products, std::int32_t* squares);

  /// The candidate (disparity, weight) that a ray gives each of n <= kHoleBatch holes at (x, y), see
  /// fillHoles(). `steps` is 0xffff where the ray meets no source; that, and an impossible
  /// candidate, gives (+infinity, 0).
  void (*gatherCandidates)(const CandidateSources& sources, const std::int32_t* x, const std::int32_t* y,
                           const std::uint16_t* steps, int n, float* disparity, std::uint32_t* weight);

  /// For each of n <= kHoleBatch holes the smallest of its kHoleRays disparities (plane k at k n) that has,
  /// together with the smaller ones, at least half of all weight, whose sum must fit 32 bits; +infinity
  /// without any.
  void (*candidateMedian)(const float* disparity, const std::uint32_t* weight, int n, float* out);
};

/// The table of an instruction set; that of the scalar build if there is none for it.
const PyramidKernels& pyramidKernels(Isa isa);

}  // namespace pomona
