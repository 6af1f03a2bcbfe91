// The inner loops of adaptive support weights, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstddef>

namespace pomona {

enum class Isa;  // core/cpu.h; kernel files must not see the standard headers it includes

/// Pixels of one call of `supportWeights` or `weightedCosts`, on every instruction set.
inline constexpr int kAswBlock = 32;
/// Disparities of one call of `weightedCosts`. Weights that are loaded once serve all of them: the kernel
/// waits for memory, not for arithmetic.
inline constexpr int kAswDisparities = 4;

/// Where the weights of one block of pixels come from. The pointers aim at the block's first pixel.
struct AswSupport {
  const float* lab[3];          ///< CIELab planes; +infinity in the first outside the view
  std::ptrdiff_t plane_stride;  ///< in elements
  int radius;                   ///< columns x - radius to x + radius
  int first_row, last_row;      ///< rows y + first_row to y + last_row, all inside the view
  const float* log_proximity;   ///< binary logarithms of the proximity weight, (2 radius + 1) per row from
                                ///< first_row on, <= 0
  float color_scale;  ///< binary logarithm of the similarity weight per unit of colour distance, negated
};

/// A block of left pixels and a group of neighbouring disparities d, d + 1, ... Taps are numbered row by row.
struct AswBlock {
  const float* left_weight;   ///< [tap * kAswBlock + x]
  const float* right_weight;  ///< of tap 0, for the match of the first pixel at d; at d + j, j before that
  std::ptrdiff_t right_tap_stride;      ///< from one tap to the next
  const float* const* raw_cost;         ///< per window row: of the row's first tap, for the first pixel at d
  std::ptrdiff_t raw_disparity_stride;  ///< from there to d + 1
  int rows, columns;
};

struct AswKernels {
  /// out[tap * tap_stride + x]: the support weight of each tap of each pixel; 0 outside the view.
  void (*supportWeights)(const AswSupport& support, float* out, std::ptrdiff_t tap_stride);
  /// out[j * kAswBlock + x] = sum of left weight * right weight * raw cost / sum of left weight * right
  /// weight, at d + j; kAswDisparities rows.
  void (*weightedCosts)(const AswBlock& block, float* out);
};

/// `isa` must be one of usableIsas().
const AswKernels& aswKernels(Isa isa);

}  // namespace pomona
