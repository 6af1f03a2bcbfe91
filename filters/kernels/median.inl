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
/// Returns the lanes where m is odd.
template <int kCount>
inline Ints balanceUnknown(Floats (&v)[kCount]) {
  Floats stand_in = broadcast(-__builtin_inff());
  Ints odd = {};
#pragma GCC unroll 32
  for (int i = 0; i < kCount; ++i) {
    const Ints unknown = isNan(v[i]);
    v[i] = unknown ? stand_in : v[i];
    stand_in = unknown ? -stand_in : stand_in;
    odd ^= unknown;
  }
  return odd;
}

void medianRow5x5(const float* const* rows, int width, float* out) {
  constexpr int kSize = 5;
  for (int x = 0; x < width; x += kFloatLanes) {
    Floats window[kSize * kSize];
#pragma GCC unroll 32
    for (int i = 0; i < kSize * kSize; ++i) window[i] = load(rows[i / kSize] + x + i % kSize - kSize / 2);
    const Floats centre = window[kSize * kSize / 2];
    Floats sum = {};  // NaN if a pixel is unknown
#pragma GCC unroll 5
    for (int i = 0; i < kSize * kSize; i += kSize)
      sum += window[i] + window[i + 1] + (window[i + 2] + window[i + 3]) + window[i + 4];
    if (anyNan(sum)) balanceUnknown(window);  // rare: it is completed maps that are smoothed so far
    storeFirst(out + x, isNan(centre) ? centre : medianOf(window), width - x);
  }
}

constexpr int kMedianChunk = 256;  ///< pixels whose columns are sorted before they are used

/// Columns of three pixels each, balanced.
struct SortedColumns {
  static constexpr int kRoom = kMedianChunk + 2 * kFloatLanes;
  float low[kRoom], middle[kRoom], high[kRoom];
  std::int32_t odd[kRoom];  ///< -1 if an odd number of pixels is unknown, else 0
};

inline void sortColumns(const float* const* rows, int begin, int count, SortedColumns& columns) {
  for (int i = 0; i < count; i += kFloatLanes) {
    Floats v[3] = {load(rows[0] + begin + i), load(rows[1] + begin + i), load(rows[2] + begin + i)};
    const Ints odd = balanceUnknown(v);
    sortPair(v[0], v[1]);
    sortPair(v[1], v[2]);
    sortPair(v[0], v[1]);
    store(columns.low + i, v[0]);
    store(columns.middle + i, v[1]);
    store(columns.high + i, v[2]);
    store(columns.odd + i, odd);
  }
}

/// Makes the odd one of the unknown pixels of column v +infinity, from -infinity, in the lanes `where` there
/// is one.
inline void raiseUnknown(Ints where, Floats (&v)[3]) {
  v[0] = where ? v[1] : v[0];
  v[1] = where ? v[2] : v[1];
  v[2] = where ? broadcast(__builtin_inff()) : v[2];
}

inline Floats medianOf3(Floats a, Floats b, Floats c) {
  return max(min(a, b), min(max(a, b), c));
}

/// The median of nine is that of three: the highest of the lowest of their columns, the median of the middle
/// ones, and the lowest of the highest. Three pixels share a column.
void medianRow3x3(const float* const* rows, int width, float* out) {
  SortedColumns columns;
  for (int begin = 0; begin < width; begin += kMedianChunk) {
    const int count = width - begin < kMedianChunk ? width - begin : kMedianChunk;
    sortColumns(rows, begin - 1, count + 2, columns);
    for (int i = 0; i < count; i += kFloatLanes) {
      Floats v[3][3];
      Ints odd[3];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        v[c][0] = load(columns.low + i + c), v[c][1] = load(columns.middle + i + c),
        v[c][2] = load(columns.high + i + c), odd[c] = load(columns.odd + i + c);
      }
      raiseUnknown(odd[0] & odd[1], v[1]);  // in turn from column to column, too
      raiseUnknown((odd[0] ^ odd[1]) & odd[2], v[2]);
      const Floats median =
          medianOf3(max(max(v[0][0], v[1][0]), v[2][0]), medianOf3(v[0][1], v[1][1], v[2][1]),
                    min(min(v[0][2], v[1][2]), v[2][2]));
      const Floats centre = load(rows[1] + begin + i);
      storeFirst(out + begin + i, isNan(centre) ? centre : median, count - i);
    }
  }
}

}  // namespace
}  // namespace pomona
