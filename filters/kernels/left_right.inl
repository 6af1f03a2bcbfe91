// The left-right check of a few pixels. GCC vectorises the loops as they stand, but for the one that gathers.
#pragma once

namespace pomona {
namespace {

/// column[i]: the right column nearest to x - d, -1 if it lies outside the image or d is NaN; difference[i] =
/// |d - d_right| there (of column 0 where there is none).
inline void matchesOf(const LeftRightPixels& p, std::int32_t* __restrict column,
                      float* __restrict difference) {
  const float *disparity = p.disparity, *right = p.right;
  const float width = static_cast<float>(p.width);
  const int count = p.count, x_begin = p.x_begin;
  for (int i = 0; i < count; ++i) {
    const float at = static_cast<float>(x_begin + i) - disparity[i] + 0.5f;  // truncated where not negative
    column[i] = static_cast<int>((at >= 0.0f) & (at < width) ? at : -1.0f);
  }
  for (int i = 0; i < count; ++i) difference[i] = right[column[i] < 0 ? 0 : column[i]];
  for (int i = 0; i < count; ++i) difference[i] = __builtin_fabsf(disparity[i] - difference[i]);
}

inline void contradictionsOf(const LeftRightPixels& p, float threshold_px, std::uint8_t* __restrict out) {
  std::int32_t column[kMatchChunk];
  float difference[kMatchChunk];
  matchesOf(p, column, difference);
  const float* disparity = p.disparity;
  const int count = p.count;
  for (int i = 0; i < count; ++i) {
    const int contradicted = difference[i] <= threshold_px ? kAgrees : kContradicted;
    const int found = column[i] < 0 ? kMatchOutside : contradicted;
    out[i] = static_cast<std::uint8_t>(disparity[i] == disparity[i] ? found : kAgrees);
  }
}

inline void metColumnsOf(const MetPixels& p, std::int32_t* __restrict first, std::int32_t* __restrict last) {
  const float *right = p.right, tolerance_px = p.tolerance_px;
  const int count = p.count, q_begin = p.q_begin, width = p.width, least = p.min_disparity,
            largest = p.max_disparity;
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
    const bool any = known & (low <= high);
    first[i] = any ? low : width;
    last[i] = any ? high : width;
  }
}

}  // namespace
}  // namespace pomona
