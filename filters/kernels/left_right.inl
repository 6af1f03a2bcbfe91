// The left-right check of a few pixels. GCC vectorises the loops as they stand.
#pragma once

namespace pomona {
namespace {

inline void metDisparitiesOf(const float* __restrict right, int count, float tolerance_px,
                             std::int32_t* __restrict first, std::int32_t* __restrict last) {
  for (int i = 0; i < count; ++i) {
    const bool known = __builtin_fabsf(right[i]) < kFarthestDisparity_px;
    const float r = known ? right[i] : 0.0f;
    int low = static_cast<int>(r - tolerance_px), high = static_cast<int>(r + tolerance_px) + 1;
    // Truncation lets one too many in, and up to two at the end.
    low += __builtin_fabsf(r - static_cast<float>(low)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    high -= __builtin_fabsf(r - static_cast<float>(high)) > tolerance_px;
    first[i] = low;
    last[i] = known ? high : low - 1;
  }
}

inline void matchesOf(const LeftRightPixels& p, std::int32_t* __restrict column,
                      float* __restrict difference) {
  const float width = static_cast<float>(p.width);
  for (int i = 0; i < p.count; ++i) {
    const float d = p.disparity[i];
    const float at = static_cast<float>(p.x_begin + i) - d + 0.5f;  // truncated below, where not negative
    const bool inside = (at >= 0.0f) & (at < width);
    const int x_right = static_cast<int>(inside ? at : -1.0f);
    column[i] = x_right;
    difference[i] = __builtin_fabsf(d - p.right[x_right < 0 ? 0 : x_right]);
  }
}

}  // namespace
}  // namespace pomona
