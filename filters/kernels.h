// The row and block kernels of the filters, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstddef>

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

struct FilterKernels {
  /// One row of the NaN-aware median, see filters/median.h. `rows` are the 3 (5) input rows around it,
  /// readable from 1 (2) pixels before their start up to the next multiple of 16 pixels, and 1 (2) more.
  void (*median3x3)(const float* const* rows, int width, float* out);
  void (*median5x5)(const float* const* rows, int width, float* out);
  /// kBilateralBlock pixels of the joint bilateral filter, NaN where unknown, see filters/joint_bilateral.h.
  void (*jointBilateral)(const BilateralWindow& window, float* out);
};

/// `isa` must be one of usableIsas().
const FilterKernels& filterKernels(Isa isa);

}  // namespace pomona
