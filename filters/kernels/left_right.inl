// The left-right check of a row. GCC vectorises the loops as they stand, but for the one that marks columns.
#pragma once

namespace pomona {
namespace {

/// column[i]: the right column nearest to x - d, -1 if it lies outside the image or d is NaN; difference[i] =
/// |d - d_right| there (of column 0 where there is none).
inline void matchesOf(const MatchedPixels& p, std::int32_t* __restrict column, float* __restrict difference) {
  const float* disparity = p.disparity;
  const float width = static_cast<float>(p.width);
  const int count = p.count, x_begin = p.x_begin;
  std::int32_t inside[kMatchChunk];
  for (int i = 0; i < count; ++i) {
    const float at = static_cast<float>(x_begin + i) - disparity[i] + 0.5f;  // truncated where not negative
    column[i] = static_cast<int>((at >= 0.0f) & (at < width) ? at : -1.0f);
    inside[i] = column[i] < 0 ? 0 : column[i];
  }
  gatherRow(p.right, inside, count, difference);
  for (int i = 0; i < count; ++i) difference[i] = __builtin_fabsf(disparity[i] - difference[i]);
}

/// Whether left columns' epipolar lines meet the right map: of those from `first` on, as far as the right
/// columns seen so far can tell. No more of them are kept than a chunk and the range have, so that they stay
/// in the first-level cache however wide the row is.
struct MetColumns {
  static constexpr int kRoom = kMatchChunk + kMostCheckedDisparities;
  int first = 0;
  std::uint8_t begins[1 + kRoom + 1] = {};  ///< from column first - 1 on; the last slot is of no column
  std::uint8_t ends[kRoom + 1] = {};

  /// Of column first + i: if it or the one before it begins a pair, or it ends a range.
  std::uint8_t has(int i) const { return begins[i] | begins[i + 1] | ends[i]; }

  void forget(int count, int disparities) {
    first += count;
    __builtin_memmove(begins, begins + count, static_cast<std::size_t>(disparities) + 1);
    __builtin_memmove(ends, ends + count, static_cast<std::size_t>(disparities));
    __builtin_memset(begins + disparities + 1, 0, static_cast<std::size_t>(count));
    __builtin_memset(ends + disparities, 0, static_cast<std::size_t>(count));
  }
};

/// The left columns q + e in the image with a whole disparity e of the range within the tolerance of the
/// right map at q are first + a[i] and the one after it, and up to first + b[i]; only b[i] if there is one.
/// Either is kRoom if not needed.
inline void metColumnsOf(const LeftRightRow& p, int first, int q_begin, int count, std::int32_t* __restrict a,
                         std::int32_t* __restrict b) {
  const float *right = p.right + q_begin, tolerance_px = p.tolerance_px;
  const int last = p.width - 1 - first;
  const int least = p.min_disparity, largest = p.max_disparity, shift = q_begin - first;
  for (int i = 0; i < count; ++i) {
    const bool known = __builtin_fabsf(right[i]) < kFarthestDisparity_px;
    const float r = known ? right[i] : 0.0f;
    int low = static_cast<int>(r - tolerance_px), high = static_cast<int>(r + tolerance_px) + 1;
    // Truncation lets one too many in, and up to two at the end.
    low += __builtin_fabsf(r - static_cast<float>(low)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    low = (low > least ? low : least) + shift + i;
    high = (high < largest ? high : largest) + shift + i;
    low = low > 0 ? low : 0;
    high = high < last ? high : last;
    a[i] = known & (low < high) ? low : MetColumns::kRoom;
    b[i] = known & (low <= high) ? high : MetColumns::kRoom;
  }
}

inline void markMetColumns(const LeftRightRow& p, int q_begin, int q_end, MetColumns& met) {
  std::int32_t a[kMatchChunk], b[kMatchChunk];
  std::uint8_t *begins = met.begins + 1, *ends = met.ends;
  for (int q = q_begin; q < q_end; q += kMatchChunk) {
    const int count = q_end - q < kMatchChunk ? q_end - q : kMatchChunk;
    metColumnsOf(p, met.first, q, count, a, b);
#pragma GCC unroll 4
    for (int i = 0; i < count; ++i) begins[a[i]] = ends[b[i]] = 1;
    if (p.tolerance_px == 1.0f) continue;  // there are three columns at most
    for (int i = 0; i < count; ++i)
      for (int x = a[i] + 2; x < b[i]; x += 2) begins[x] = 1;
  }
}

inline void leftRightRow(const LeftRightRow& p) {
  const int disparities = p.max_disparity - p.min_disparity + 1;
  MetColumns met;
  int seen = 0;  // right columns
  const std::uint8_t measured = p.measured, out_of_range = p.out_of_range, mismatched = p.mismatched,
                     occluded = p.occluded;
  const float threshold_px = p.threshold_px;
  std::int32_t column[kMatchChunk];
  float difference[kMatchChunk];
  std::uint8_t rejected[kMatchChunk], outside[kMatchChunk];
  for (int x = 0; x < p.width; x += kMatchChunk) {
    const int count = p.width - x < kMatchChunk ? p.width - x : kMatchChunk;
    float* __restrict disparity = p.disparity + x;
    std::uint8_t* __restrict state = p.state + x;
    // The last right column that may meet one of these.
    const int reach = x + count - p.min_disparity, to_see = reach < p.width ? reach : p.width;
    if (to_see > seen) {
      markMetColumns(p, seen, to_see, met);
      seen = to_see;
    }
    matchesOf({disparity, p.right, x, count, p.width}, column, difference);
    for (int i = 0; i < count; ++i) {
      outside[i] = column[i] < 0;
      rejected[i] = (disparity[i] == disparity[i]) & !((column[i] >= 0) & (difference[i] <= threshold_px));
    }
    for (int i = 0; i < count; ++i) {
      const std::uint8_t inside = met.has(i) ? mismatched : occluded,
                         reason = outside[i] ? out_of_range : inside;
      rejected[i] = rejected[i] & (state[i] == measured);
      state[i] = rejected[i] ? reason : state[i];
    }
    for (int i = 0; i < count; ++i) disparity[i] = rejected[i] ? __builtin_nanf("") : disparity[i];
    met.forget(count, disparities);
  }
}

}  // namespace
}  // namespace pomona
