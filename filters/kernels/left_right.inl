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

/// The left columns q + e in the image with a whole disparity e of the range within the tolerance of the
/// right map at q are a[i] and a[i] + 1, and up to b[i]; only b[i] if there is one. Either is `width` if not
/// needed.
inline void metColumnsOf(const LeftRightRow& p, int q_begin, int count, std::int32_t* __restrict a,
                         std::int32_t* __restrict b) {
  const float *right = p.right + q_begin, tolerance_px = p.tolerance_px;
  const int width = p.width, least = p.min_disparity, largest = p.max_disparity;
  for (int i = 0; i < count; ++i) {
    const bool known = __builtin_fabsf(right[i]) < kFarthestDisparity_px;
    const float r = known ? right[i] : 0.0f;
    int low = static_cast<int>(r - tolerance_px), high = static_cast<int>(r + tolerance_px) + 1;
    // Truncation lets one too many in, and up to two at the end.
    low += __builtin_fabsf(r - static_cast<float>(low)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    low = (low > least ? low : least) + q_begin + i;
    high = (high < largest ? high : largest) + q_begin + i;
    low = low > 0 ? low : 0;
    high = high < width - 1 ? high : width - 1;
    a[i] = known & (low < high) ? low : width;
    b[i] = known & (low <= high) ? high : width;
  }
}

/// Marks the left columns whose epipolar line meets the right map: x is one if begins[x], begins[x - 1] or
/// ends[x] is set. All have `width` elements, one before and one after.
inline void markMetColumns(const LeftRightRow& p, std::uint8_t* begins, std::uint8_t* ends) {
  std::int32_t a[kMatchChunk], b[kMatchChunk];
  __builtin_memset(begins - 1, 0, static_cast<std::size_t>(p.width) + 2);
  __builtin_memset(ends - 1, 0, static_cast<std::size_t>(p.width) + 2);
  for (int q = 0; q < p.width; q += kMatchChunk) {
    const int count = p.width - q < kMatchChunk ? p.width - q : kMatchChunk;
    metColumnsOf(p, q, count, a, b);
    for (int i = 0; i < count; ++i) begins[a[i]] = ends[b[i]] = 1;
    if (p.tolerance_px == 1.0f) continue;  // there are three columns at most
    for (int i = 0; i < count; ++i)
      for (int x = a[i] + 2; x < b[i]; ++x) ends[x] = 1;
  }
  begins[p.width] = 0;
}

inline void leftRightRow(const LeftRightRow& p) {
  std::uint8_t *begins = p.marks + 1, *ends = begins + p.width + 2;
  markMetColumns(p, begins, ends);
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
    const std::uint8_t *begin = begins + x, *end = ends + x;
    matchesOf({disparity, p.right, x, count, p.width}, column, difference);
    for (int i = 0; i < count; ++i) {
      outside[i] = column[i] < 0;
      rejected[i] = (disparity[i] == disparity[i]) & !((column[i] >= 0) & (difference[i] <= threshold_px));
    }
    for (int i = 0; i < count; ++i) {
      const std::uint8_t met = begin[i] | begin[i - 1] | end[i];
      const std::uint8_t inside = met ? mismatched : occluded, reason = outside[i] ? out_of_range : inside;
      rejected[i] = rejected[i] & (state[i] == measured);
      state[i] = rejected[i] ? reason : state[i];
    }
    for (int i = 0; i < count; ++i) disparity[i] = rejected[i] ? __builtin_nanf("") : disparity[i];
  }
}

}  // namespace
}  // namespace pomona
