// Where between whole disparities the minimum lies, and how clear it is. GCC vectorises the loops as they
// stand.
#pragma once

#include "sgm/kernels.h"

namespace {

// Offsets from the middle of three equidistant costs towards the smaller side, in [0, 1/2], given how far the
// sides lie above the middle: 0 <= low <= high, 0 < high.
struct NoOffset {
  static float of(float, float, const pomona::SubpixelCurve&) { return 0; }
};
/// Vertex of the parabola: (high - low) / (2 (high + low)).
struct ParabolaOffset {
  static float of(float low, float high, const pomona::SubpixelCurve&) {
    return 0.5f * (high - low) / (high + low);
  }
};
/// Apex of two lines of equal and opposite slope: (high - low) / (2 high).
struct EquiangularOffset {
  static float of(float low, float high, const pomona::SubpixelCurve&) { return 0.5f * (high - low) / high; }
};
struct FittedOffset {
  static float of(float low, float high, const pomona::SubpixelCurve& curve) {
    const float r = low / high;
    return 0.5f - r * (curve.a + r * (curve.b + r * curve.c));
  }
};

void scoreRow(const pomona::ScoreRow& r) {
  const std::uint16_t *best = r.best, *below = r.below, *above = r.above, *second = r.second;
  std::uint16_t* __restrict margin = r.margin, * __restrict curvature = r.curvature;
  const int width = r.width;
  for (int x = 0; x < width; ++x) {
    margin[x] = static_cast<std::uint16_t>(second[x] > best[x] ? second[x] - best[x] : 0);
    const int bend = below[x] + above[x] - 2 * best[x];
    curvature[x] = static_cast<std::uint16_t>(bend > 0 ? bend : 0);
  }
}

template <typename Offset>
void refineRow(const pomona::RefineRow& r) {
  const std::uint16_t *index = r.index, *best = r.best, *below = r.below, *above = r.above;
  float* __restrict disparity = r.disparity;
  const pomona::SubpixelCurve curve = r.curve;
  const int last = r.disparities - 1, first_disparity = r.min_disparity;
  for (int x = 0; x < r.width; ++x) {
    const int d = index[x], middle = best[x];
    const float down = static_cast<float>(below[x] - middle), up = static_cast<float>(above[x] - middle);
    const float low = down < up ? down : up, high = down < up ? up : down;
    const float offset = Offset::of(low, high > 0 ? high : 1.0f, curve);
    const float sign = down < up ? -1.0f : 1.0f;
    const float inner = (d > 0) & (d < last) ? sign : 0.0f;
    const float value = static_cast<float>(first_disparity + d) + inner * offset;
    disparity[x] = d == pomona::kNoIndex ? __builtin_nanf("") : value;
  }
}

}  // namespace
