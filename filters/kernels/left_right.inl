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

inline bool meetsAnyOf(const float* right, int count, int disparity, float tolerance_px) {
  const Floats tolerance = broadcast(tolerance_px),
               first = broadcast(static_cast<float>(disparity)) - laneNumbers();
  int i = 0;
  for (; i + kFloatLanes <= count; i += kFloatLanes) {
    const Floats off = load(right + i) - (first - broadcast(static_cast<float>(i)));
    if (any((off <= tolerance) & (off >= -tolerance))) return true;
  }
  for (; i < count; ++i)
    if (__builtin_fabsf(right[i] - static_cast<float>(disparity - i)) <= tolerance_px) return true;
  return false;
}

}  // namespace
}  // namespace pomona
