// Colour-weighted median at chosen pixels; every lane of a vector is one of them.
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace pomona {
namespace {

constexpr int kMedianSide = 2 * kWeightedMedianRadius + 1;

/// Elements that lie apart from each other in memory.
inline Ints gather(const void* base, Ints index) {
#if defined(__AVX512F__)
  return reinterpret_cast<Ints>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(index), base, 4));
#elif defined(__AVX2__)
  return reinterpret_cast<Ints>(
      _mm256_i32gather_epi32(static_cast<const int*>(base), reinterpret_cast<__m256i>(index), 4));
#else
  Ints v;
  for (int i = 0; i < kFloatLanes; ++i) v[i] = static_cast<const std::int32_t*>(base)[index[i]];
  return v;
#endif
}

/// Maps the bits of a float to an integer of the same order, and back.
inline Ints orderedBits(Ints bits) {
  return bits ^ (bits >> 31 & 0x7FFFFFFF);
}

/// The window of each lane's pixel: ordered bits of the disparities, and their weights.
struct WeightedWindow {
  Ints key[kMedianSide][kMedianSide];
  Floats weight[kMedianSide][kMedianSide];
};

/// The weight of one window row: 2^(log_weight - scaled colour difference); 0 where the disparity is unknown.
inline void readWindowRow(const float* disparity, const std::uint32_t* color, const float* log_weight,
                          Ints columns, Ints centre_color, Ints (&key)[kMedianSide],
                          Floats (&weight)[kMedianSide]) {
  Ints known[kMedianSide];
#pragma GCC unroll 16
  for (int i = 0; i < kMedianSide; ++i) {
    const int dx = i - kWeightedMedianRadius;
    const Ints bits = gather(disparity + dx, columns);
    const Ints difference = sumOfChannels(absoluteDifference(gather(color + dx, columns), centre_color));
    known[i] = ~isNan(floatsOf(bits));
    key[i] = orderedBits(bits);
    weight[i] = log_weight[i] - __builtin_convertvector(difference, Floats) * kMedianColorScale;
  }
  exp2NonPositive(weight);
#pragma GCC unroll 16
  for (int i = 0; i < kMedianSide; ++i) weight[i] = floatsOf(bitsOf(weight[i]) & known[i]);
}

/// The weights of all keys up to `bound`. Adding in one fixed order makes this sum, though rounded, a
/// monotone function of `bound`.
inline Floats weightUpTo(const WeightedWindow& window, Ints bound) {
  Floats sum[kMedianSide] = {};
  for (int row = 0; row < kMedianSide; ++row)
#pragma GCC unroll 16
    for (int i = 0; i < kMedianSide; ++i)
      sum[i] += window.key[row][i] <= bound ? window.weight[row][i] : Floats{};
  Floats total = sum[0];
  for (int i = 1; i < kMedianSide; ++i) total += sum[i];
  return total;
}

/// The bits needed for the largest lane, taken as an unsigned number.
inline int bitWidth(Ints v) {
  std::uint32_t all = 0;
  for (int i = 0; i < kFloatLanes; ++i) all |= static_cast<std::uint32_t>(v[i]);
  return all == 0 ? 0 : 32 - __builtin_clz(all);
}

/// The smallest key up to which there is half of the weight, by bisection.
inline Ints weightedMedianKey(const WeightedWindow& window, Ints centre_key) {
  Ints low = centre_key, high = centre_key;
  for (int row = 0; row < kMedianSide; ++row)
#pragma GCC unroll 16
    for (int i = 0; i < kMedianSide; ++i) {
      const Ints key = bitsOf(window.weight[row][i]) == 0 ? centre_key : window.key[row][i];
      low = key < low ? key : low;
      high = key > high ? key : high;
    }
  const Floats half = weightUpTo(window, high) * 0.5f;
  for (int bits = bitWidth(high - low); bits > 0; --bits) {
    const Ints middle = (low & high) + ((low ^ high) >> 1);
    const Ints enough = weightUpTo(window, middle) >= half;
    high = enough ? middle : high;
    low = enough ? low : middle + 1;
  }
  return high;
}

void weightedMedianAt(const GuidedRow& row, const float* log_weight, const std::int32_t* columns, int count,
                      float* out) {
  for (int begin = 0; begin < count; begin += kFloatLanes) {
    const int lanes = count - begin < kFloatLanes ? count - begin : kFloatLanes;
    Ints x;
    for (int i = 0; i < kFloatLanes; ++i) x[i] = columns[begin + (i < lanes ? i : 0)];
    const Ints centre_color = gather(row.color, x);
    WeightedWindow window;
    for (int i = 0; i < kMedianSide; ++i) {
      const std::ptrdiff_t offset = (i - kWeightedMedianRadius) * row.stride;
      readWindowRow(row.disparity + offset, row.color + offset, log_weight + i * kMedianSide, x, centre_color,
                    window.key[i], window.weight[i]);
    }
    const Ints centre_key = window.key[kWeightedMedianRadius][kWeightedMedianRadius];
    const Floats median = floatsOf(orderedBits(weightedMedianKey(window, centre_key)));
    for (int i = 0; i < lanes; ++i) out[x[i]] = median[i];
  }
}

void markNearJumps(const GuidedRow& row, int width, float threshold_px, std::uint8_t* near) {
  const float* rows[3] = {row.disparity - row.stride, row.disparity, row.disparity + row.stride};
  for (int x = 0; x < width; ++x) {
    float low = rows[1][x], high = low;
    for (const float* d : rows)
      for (int dx = -1; dx <= 1; ++dx) {
        low = d[x + dx] < low ? d[x + dx] : low;
        high = d[x + dx] > high ? d[x + dx] : high;
      }
    near[x] = (high - rows[1][x] > threshold_px) | (rows[1][x] - low > threshold_px);
  }
}

}  // namespace
}  // namespace pomona
