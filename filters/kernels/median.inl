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

/// kCount vectors, sorted lane by lane.
template <int kCount>
struct Sorted {
  Floats v[kCount];
};

/// Every second one, from the first or from the second on.
template <int kFirst, int kCount>
inline Sorted<(kCount + 1 - kFirst) / 2> everySecond(const Sorted<kCount>& from) {
  Sorted<(kCount + 1 - kFirst) / 2> some;
#pragma GCC unroll 8
  for (int i = 0; 2 * i + kFirst < kCount; ++i) some.v[i] = from.v[2 * i + kFirst];
  return some;
}

/// K. E. Batcher, "Sorting networks and their applications", AFIPS 1968: merge the odd ones and the even
/// ones, and only neighbours are left to be compared. What the caller does not look at costs nothing.
template <int kCount>
inline Sorted<2 * kCount> merge(const Sorted<kCount>& a, const Sorted<kCount>& b) {
  Sorted<2 * kCount> all;
  if constexpr (kCount == 1) {
    all = {{a.v[0], b.v[0]}};
    sortPair(all.v[0], all.v[1]);
  } else {
    const auto odd = merge(everySecond<0>(a), everySecond<0>(b));
    const auto even = merge(everySecond<1>(a), everySecond<1>(b));
    all.v[0] = odd.v[0];
#pragma GCC unroll 16
    for (int i = 0; i + 1 < kCount; ++i) {
      all.v[2 * i + 1] = odd.v[i + 1];
      all.v[2 * i + 2] = even.v[i];
      sortPair(all.v[2 * i + 1], all.v[2 * i + 2]);
    }
    all.v[2 * kCount - 1] = kCount % 2 != 0 ? odd.v[kCount] : even.v[kCount - 1];
  }
  return all;
}

inline void sortFive(Floats (&v)[5]) {
  sortPair(v[0], v[3]), sortPair(v[1], v[4]);
  sortPair(v[0], v[2]), sortPair(v[1], v[3]);
  sortPair(v[0], v[1]), sortPair(v[2], v[4]);
  sortPair(v[1], v[2]), sortPair(v[3], v[4]);
  sortPair(v[2], v[3]);
}

/// kCount values of each pixel of a chunk, sorted.
template <int kCount>
struct SortedRows {
  float v[kCount][kMedianChunk + 2 * kFloatLanes];

  Sorted<kCount> at(int i) const {
    Sorted<kCount> all;
#pragma GCC unroll 16
    for (int k = 0; k < kCount; ++k) all.v[k] = load(v[k] + i);
    return all;
  }
  void set(int i, const Sorted<kCount>& all) {
#pragma GCC unroll 16
    for (int k = 0; k < kCount; ++k) store(v[k] + i, all.v[k]);
  }
};

/// Columns of five pixels each, and pairs of neighbouring columns; of no use where a pixel is unknown.
struct ColumnsOfFive {
  SortedRows<5> one;
  SortedRows<10> pair;                        ///< of this column and the next one
  float sum[kMedianChunk + 2 * kFloatLanes];  ///< NaN if a pixel is unknown
};

inline void sortColumns(const float* const* rows, int begin, int count, ColumnsOfFive& columns) {
  for (int i = 0; i < count + 4; i += kFloatLanes) {
    Sorted<5> column;
#pragma GCC unroll 5
    for (int k = 0; k < 5; ++k) column.v[k] = load(rows[k] + begin + i);
    const auto& v = column.v;
    store(columns.sum + i, v[0] + v[1] + (v[2] + v[3]) + v[4]);
    sortFive(column.v);
    columns.one.set(i, column);
  }
  for (int i = 0; i < count + 2; i += kFloatLanes)
    columns.pair.set(i, merge(columns.one.at(i), columns.one.at(i + 1)));
}

/// The median of the 5x5 pixels of five columns, the first one at `i`: of two pairs, and of what is left.
inline Floats medianOfColumns(const ColumnsOfFive& columns, int i) {
  constexpr int kMiddle = 12;  // of 25, from 0
  const Sorted<20> four = merge(columns.pair.at(i), columns.pair.at(i + 2));
  const Sorted<5> fifth = columns.one.at(i + 4);
  // If the first k + 1 of the fifth column are among the lower ones, so are the first kMiddle - k of the
  // others.
  Floats median = four.v[kMiddle];
#pragma GCC unroll 5
  for (int k = 0; k < 5; ++k) median = min(median, max(fifth.v[k], four.v[kMiddle - 1 - k]));
  return median;
}

/// Of one vector, any of its windows' pixels may be unknown.
inline Floats medianOfBalanced5x5(const float* const* rows, int x) {
  constexpr int kSize = 5;
  Floats window[kSize * kSize];
#pragma GCC unroll 32
  for (int i = 0; i < kSize * kSize; ++i) window[i] = load(rows[i / kSize] + x + i % kSize - kSize / 2);
  const Floats centre = window[kSize * kSize / 2];
  balanceUnknown(window);
  return isNan(centre) ? centre : medianOf(window);
}

/// Five pixels share a column, and four a pair.
void medianRow5x5(const float* const* rows, int width, float* out) {
  ColumnsOfFive columns;
  for (int begin = 0; begin < width; begin += kMedianChunk) {
    const int count = width - begin < kMedianChunk ? width - begin : kMedianChunk;
    sortColumns(rows, begin - 2, count, columns);
    for (int i = 0; i < count; i += kFloatLanes) {
      const float* const sum = columns.sum + i;
      const Floats known = load(sum) + load(sum + 1) + (load(sum + 2) + load(sum + 3)) + load(sum + 4);
      // Rare: it is completed maps that are smoothed so far.
      const Floats median =
          anyNan(known) ? medianOfBalanced5x5(rows, begin + i) : medianOfColumns(columns, i);
      storeFirst(out + begin + i, median, count - i);
    }
  }
}

}  // namespace
}  // namespace pomona
