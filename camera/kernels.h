// The row kernels of this folder, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pomona {

enum class Isa;  // core/cpu.h; kernel files must not see the standard headers it includes

/// Four rows, one below the other, and how much each counts: the weights sum up to kRowWeights.
template <typename T>
struct WeightedRows {
  const T* row[4];
  int weight[4];
};
inline constexpr int kRowWeights = 4096;

struct CameraKernels {
  /// out[x] = the weighted mean of the rows at x, rounded and clamped to the type's range, for begin <= x <
  /// end.
  void (*interpolate8)(const WeightedRows<std::uint8_t>& rows, int begin, int end, std::uint8_t* out);
  void (*interpolate16)(const WeightedRows<std::uint16_t>& rows, int begin, int end, std::uint16_t* out);
  /// out[x] = the mean of `scale` x `scale` pixels (1, 2 or 4), rounded; `in` is the first row of them.
  void (*reduceBlocks)(const std::uint8_t* in, std::ptrdiff_t stride, int scale, int width,
                       std::uint8_t* out);
  /// out[x] = 128 + what here[x] stands out from the mean of above[x], below[x], and the pixels
  /// kContrastReach to its left and right, or the outermost, clamped.
  void (*contrast)(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below, int width,
                   std::uint8_t* out);
};
inline constexpr int kContrastReach = 3;

/// `isa` must be one of usableIsas().
const CameraKernels& cameraKernels(Isa isa);

}  // namespace pomona
