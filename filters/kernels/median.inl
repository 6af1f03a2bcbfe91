// NaN-aware median of a square window, one vector of output pixels at a time.
#pragma once

namespace pomona {
namespace {

inline void sortPair(Floats& low, Floats& high) {
  const Floats smaller = min(low, high);
  high = max(low, high);
  low = smaller;
}

/// Moves the smallest of v[first..last] to v[first] and the largest to v[last].
inline void moveExtremesOut(Floats* v, int first, int last) {
  const int reach = (last - first) / 2;
#pragma GCC unroll 16
  for (int i = 0; 2 * i < last - first; ++i) sortPair(v[first + i], v[last - i]);
#pragma GCC unroll 16
  for (int i = 1; i <= reach; ++i) {
    sortPair(v[first], v[first + i]);
    sortPair(v[last - i], v[last]);
  }
}

/// Selection by forgetting: among kCount / 2 + 2 values the smallest and the largest have too many values on
/// one side to be the median of all kCount (odd). Forget both, admit one of the remaining values, and repeat.
template <int kCount>
inline Floats medianOf(Floats (&v)[kCount]) {
  constexpr int kLast = kCount / 2 + 1;
  int first = 0;
#pragma GCC unroll 16
  for (int next = kLast + 1; next < kCount; ++next) {
    moveExtremesOut(v, first++, kLast);
    v[kLast] = v[next];
  }
  moveExtremesOut(v, first, kLast);
  return v[first + 1];
}

/// Replaces unknown values by -infinity and +infinity in turn. Of m unknown values ceil(m / 2) come to lie
/// below the known ones and floor(m / 2) above, which puts the (lower) median of these in the middle of all.
template <int kCount>
inline void balanceUnknown(Floats (&v)[kCount]) {
  Floats stand_in = broadcast(-__builtin_inff());
#pragma GCC unroll 32
  for (int i = 0; i < kCount; ++i) {
    const Ints unknown = isNan(v[i]);
    v[i] = unknown ? stand_in : v[i];
    stand_in = unknown ? -stand_in : stand_in;
  }
}

template <int kSize>
void medianRow(const float* const* rows, int width, float* out) {
  for (int x = 0; x < width; x += kFloatLanes) {
    Floats window[kSize * kSize];
#pragma GCC unroll 32
    for (int i = 0; i < kSize * kSize; ++i) window[i] = load(rows[i / kSize] + x + i % kSize - kSize / 2);
    const Floats centre = window[kSize * kSize / 2];
    balanceUnknown(window);
    storeFirst(out + x, isNan(centre) ? centre : medianOf(window), width - x);
  }
}

}  // namespace
}  // namespace pomona
