// Adaptive support weights: every lane of a vector is one pixel, so sums run over the taps in one order.
#include "baselines/kernels.h"
#include "core/simd/float.h"
#include "filters/kernels/exp2.inl"

namespace pomona {
namespace {

/// Correctly rounded, as IEEE 754 asks for, on every instruction set. (Masked with all lanes on: see min() in
/// core/simd/float.h.)
inline Floats squareRoot(Floats v) {
#if defined(__AVX512F__)
  return _mm512_maskz_sqrt_ps(0xFFFF, v);
#elif defined(__AVX2__)
  return _mm256_sqrt_ps(v);
#else
  for (int i = 0; i < kFloatLanes; ++i) v[i] = __builtin_sqrtf(v[i]);
  return v;
#endif
}

/// The weights of one tap, whose pixels start `offset` elements from the block's.
inline void tapWeights(const AswSupport& support, std::ptrdiff_t offset, float log_proximity, float* out) {
  constexpr int kVectors = 2;
  const Floats inside_limit = broadcast(__builtin_inff());
  for (int first = 0; first < kAswBlock; first += kVectors * kFloatLanes) {
    Floats square[kVectors], weight[kVectors];
    for (int c = 0; c < 3; ++c)
      for (int v = 0; v < kVectors; ++v) {
        const float* centre = support.lab[c] + first + v * kFloatLanes;
        const Floats difference = load(centre + offset) - load(centre);
        square[v] = c == 0 ? difference * difference : square[v] + difference * difference;
      }
    for (int v = 0; v < kVectors; ++v)
      weight[v] = log_proximity - squareRoot(square[v]) * support.color_scale;
    exp2NonPositive(weight);
    for (int v = 0; v < kVectors; ++v)
      store(out + first + v * kFloatLanes, square[v] < inside_limit ? weight[v] : Floats{});
  }
}

void supportWeights(const AswSupport& support, float* out, std::ptrdiff_t tap_stride) {
  const float* log_proximity = support.log_proximity;
  for (int row = support.first_row; row <= support.last_row; ++row)
    for (int column = -support.radius; column <= support.radius; ++column, out += tap_stride)
      tapWeights(support, row * support.plane_stride + column, *log_proximity++, out);
}

void weightedCosts(const AswBlock& block, float* out) {
#if defined(__AVX512F__)
  constexpr int kVectors = 2;
#else
  constexpr int kVectors = 1;  // 16 registers: two sums per disparity, and what is being added
#endif
  static_assert(kAswBlock % (kVectors * kFloatLanes) == 0);
  for (int first = 0; first < kAswBlock; first += kVectors * kFloatLanes) {
    Floats sum[kAswDisparities][kVectors] = {}, weight_sum[kAswDisparities][kVectors] = {};
    const float* left = block.left_weight + first;
    const float* right = block.right_weight + first;
    for (int row = 0; row < block.rows; ++row) {
      const float* raw = block.raw_cost[row] + first;
      for (int column = 0; column < block.columns; ++column, ++raw) {
        for (int v = 0; v < kVectors; ++v) {
          const Floats left_weight = load(left + v * kFloatLanes);
          for (int j = 0; j < kAswDisparities; ++j) {
            const Floats weight = left_weight * load(right + v * kFloatLanes - j);
            sum[j][v] = sum[j][v] + weight * load(raw + v * kFloatLanes + j * block.raw_disparity_stride);
            weight_sum[j][v] = weight_sum[j][v] + weight;
          }
        }
        left += kAswBlock;
        right += block.right_tap_stride;
      }
    }
    for (int j = 0; j < kAswDisparities; ++j)
      for (int v = 0; v < kVectors; ++v)
        store(out + j * kAswBlock + first + v * kFloatLanes, sum[j][v] / weight_sum[j][v]);
  }
}

constexpr AswKernels kTable = {supportWeights, weightedCosts};

}  // namespace
}  // namespace pomona
