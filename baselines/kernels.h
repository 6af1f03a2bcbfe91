// The inner loops of adaptive support weights, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstddef>

namespace pomona {

enum class Isa;  // core/cpu.h; kernel files must not see the standard headers it includes

/// Pixels of one call of `supportWeights` or `weightedCosts`, on every instruction set.
inline constexpr int kAswBlock = 64;

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

/// The costs of one block of left pixels at one disparity. Taps are numbered row by row.
struct AswBlock {
  const float* left_weight;  ///< of tap 0 for the block's first pixel
  const float* right_weight;
  std::ptrdiff_t left_tap_stride, right_tap_stride;  ///< from one tap to the next
  const float* const* raw_cost;  ///< per window row: of the row's first tap for the block's first pixel
  int rows, columns;
};

struct AswKernels {
  /// out[tap * tap_stride + x]: the support weight of each tap of each pixel; 0 outside the view.
  void (*supportWeights)(const AswSupport& support, float* out, std::ptrdiff_t tap_stride);
  /// out[x] = sum of left weight * right weight * raw cost / sum of left weight * right weight.
  void (*weightedCosts)(const AswBlock& block, float* out);
};

/// `isa` must be one of usableIsas().
const AswKernels& aswKernels(Isa isa);

}  // namespace pomona
