// Distances between descriptors, compiled for the instruction set of the including file. Bytes in plain loops
// that the compiler turns into vectors, knowing the lengths; floats in lanes, whose number is the same on
// every instruction set: so is the order of a sum, and its last bit.
#include "core/simd/float.h"
#include "plugins/common/kernels.h"

namespace pomona {
namespace {

constexpr int kLanes = 32;

/// One running value per lane; value i of a descriptor goes to lane i % kLanes.
struct Lanes {
  static constexpr int kVectors = kLanes / kFloatLanes;
  Floats vector[kVectors] = {};

  /// The lanes combined in pairs, lane i with lane i + half of them, again and again.
  template <typename Combine>
  [[gnu::always_inline]] float reduced(Combine combine) const {
    typedef float Quad __attribute__((vector_size(16)));
    Quad quad[kLanes / 4];
    __builtin_memcpy(quad, vector, sizeof quad);
    for (int half = kLanes / 8; half > 0; half /= 2)
      for (int i = 0; i < half; ++i) quad[i] = combine(quad[i], quad[i + half]);
    return combine(combine(quad[0][0], quad[0][2]), combine(quad[0][1], quad[0][3]));
  }
};

/// Calls visit(v, difference) for the differences of all values, vector by vector; those beyond the end are
/// 0.
template <typename Visit>
[[gnu::always_inline]] inline void forDifferences(const float* a, const float* b, int length, Visit visit) {
  int i = 0;
  for (; i + kLanes <= length; i += kLanes)
    for (int v = 0; v < Lanes::kVectors; ++v)
      visit(v, load(a + i + v * kFloatLanes) - load(b + i + v * kFloatLanes));
  if (i == length) return;
  float rest[kLanes] = {};
  for (int k = 0; i < length; ++i, ++k) rest[k] = a[i] - b[i];
  for (int v = 0; v < Lanes::kVectors; ++v) visit(v, load(rest + v * kFloatLanes));
}

[[gnu::always_inline]] inline std::int32_t squares(const std::uint8_t* a, const std::uint8_t* b, int length) {
  std::int32_t sum = 0;
  for (int i = 0; i < length; ++i) {
    const std::int16_t difference = static_cast<std::int16_t>(a[i] - b[i]);
    sum += difference * difference;
  }
  return sum;
}

struct SquaredEuclid {
  float limit = 0;  // of bytes: half of the values are often enough

  [[gnu::always_inline]] float operator()(const std::uint8_t* a, const std::uint8_t* b, int length) const {
    const int half = length / 2;
    const std::int32_t first = squares(a, b, half);
    if (static_cast<float>(first) >= limit) return static_cast<float>(first);
    return static_cast<float>(first + squares(a + half, b + half, length - half));
  }

  [[gnu::always_inline]] float operator()(const float* a, const float* b, int length) const {
    Lanes sum;
    forDifferences(a, b, length, [&](int v, Floats difference) { sum.vector[v] += difference * difference; });
    return sum.reduced([](auto x, auto y) { return x + y; });
  }
};

struct Weighted {
  DistanceWeights weights;
  float limit = 0;  // of bytes: the sum alone is often enough, and is a quarter of the work

  [[gnu::always_inline]] float operator()(const std::uint8_t* a, const std::uint8_t* b, int length) const {
    std::int32_t sum = 0;
    for (int i = 0; i < length; ++i) sum += __builtin_abs(a[i] - b[i]);
    const float cityblock = weights.cityblock * static_cast<float>(sum);
    if (cityblock >= limit) return cityblock;
    std::uint8_t largest = 0;
    for (int i = 0; i < length; ++i) {
      const std::uint8_t high = a[i] > b[i] ? a[i] : b[i], low = a[i] > b[i] ? b[i] : a[i];
      const std::uint8_t difference = static_cast<std::uint8_t>(high - low);
      largest = difference > largest ? difference : largest;
    }
    return cityblock + weights.chessboard * static_cast<float>(largest);
  }

  [[gnu::always_inline]] float operator()(const float* a, const float* b, int length) const {
    Lanes sum, largest;
    forDifferences(a, b, length, [&](int v, Floats difference) {
      const Floats size = max(difference, -difference);
      sum.vector[v] += size;
      largest.vector[v] = max(size, largest.vector[v]);
    });
    return weights.cityblock * sum.reduced([](auto x, auto y) { return x + y; }) +
           weights.chessboard * largest.reduced([](auto x, auto y) { return x > y ? x : y; });
  }
};

template <typename Value, typename Distance>
[[gnu::always_inline]] inline void distances(const Value* query, const Value* others, int length, int count,
                                             Distance distance, float* out) {
  switch (length) {  // those of SIFT and SURF, for which the loops unroll
    case 64:
      for (int i = 0; i < count; ++i, others += 64) out[i] = distance(query, others, 64);
      break;
    case 128:
      for (int i = 0; i < count; ++i, others += 128) out[i] = distance(query, others, 128);
      break;
    default:
      for (int i = 0; i < count; ++i, others += length) out[i] = distance(query, others, length);
  }
}

void squaredEuclid8Of(const std::uint8_t* query, const std::uint8_t* others, int length, int count,
                      float limit, float* out) {
  distances(query, others, length, count, SquaredEuclid{limit}, out);
}

void squaredEuclid32Of(const float* query, const float* others, int length, int count, float* out) {
  distances(query, others, length, count, SquaredEuclid{}, out);
}

void weighted8Of(const std::uint8_t* query, const std::uint8_t* others, int length, int count,
                 DistanceWeights weights, float limit, float* out) {
  distances(query, others, length, count, Weighted{weights, limit}, out);
}

void weighted32Of(const float* query, const float* others, int length, int count, DistanceWeights weights,
                  float* out) {
  distances(query, others, length, count, Weighted{weights}, out);
}

constexpr DistanceKernels kTable = {.squaredEuclid8 = squaredEuclid8Of,
                                    .squaredEuclid32 = squaredEuclid32Of,
                                    .weighted8 = weighted8Of,
                                    .weighted32 = weighted32Of};

}  // namespace
}  // namespace pomona
