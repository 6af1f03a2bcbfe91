// Textbook twins of the refinement of dense maps: slow, obvious, in double precision, written from the
// definitions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/image.h"
#include "tests/reference/filters.h"

namespace pomona::reference {

/// Known pixels q around (y, x), as far away as `radius` in either direction: visit(v, u).
template <typename Visit>
void forEachKnown(const Map<float>& map, int y, int x, int radius, Visit visit) {
  for (int v = y - radius; v <= y + radius; ++v)
    for (int u = x - radius; u <= x + radius; ++u)
      if (map.contains(v, u) && !std::isnan(map.at(v, u))) visit(v, u);
}

inline bool isNearJump(const Map<float>& map, int y, int x, float jump) {
  bool near = false;
  forEachKnown(map, y, x, 1, [&](int v, int u) { near |= std::abs(map.at(v, u) - map.at(y, x)) > jump; });
  return near;
}

/// The share of the weight that window disparities below a value have, and that those up to it have. A value
/// is a weighted median if `below` < 1/2 <= `up_to`.
struct WeightShare {
  double below = 0, up_to = 0;
};

inline WeightShare weightShare(const Map<float>& map, GuideView guide, int y, int x, float value) {
  double below = 0, up_to = 0, all = 0;
  forEachKnown(map, y, x, 5, [&](int v, int u) {
    if ((std::abs(v - y) + std::abs(u - x)) % 2 == 1) return;
    double color = 0;
    for (int c = 0; c < guide.channels; ++c)
      color += std::abs(guide.row(v)[u * guide.channels + c] - guide.row(y)[x * guide.channels + c]);
    const double weight = std::exp(-color / guide.channels / 8 - std::hypot(v - y, u - x) / 9);
    all += weight;
    if (map.at(v, u) < value) below += weight;
    if (map.at(v, u) <= value) up_to += weight;
  });
  return {below / all, up_to / all};
}

/// Solves the ridge regression by Cramer's rule on the sums about the mean.
inline Map<float> refinePlanes(const Map<float>& map, GuideView guide, int radius) {
  Map<float> out = map;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      if (std::isnan(map.at(y, x))) continue;
      struct Sample {
        double x, y, z;
      };
      std::vector<Sample> samples;
      forEachKnown(map, y, x, radius, [&](int v, int u) {
        if (std::abs(map.at(v, u) - map.at(y, x)) >= 1) return;
        for (int c = 0; c < guide.channels; ++c)
          if (std::abs(guide.row(v)[u * guide.channels + c] - guide.row(y)[x * guide.channels + c]) >= 15)
            return;
        samples.push_back({1.0 * (u - x), 1.0 * (v - y), double{map.at(v, u)} - map.at(y, x)});
      });
      if (samples.size() < 6) continue;
      Sample mean{};
      const double n = static_cast<double>(samples.size());
      for (const Sample& s : samples) mean = {mean.x + s.x / n, mean.y + s.y / n, mean.z + s.z / n};
      double xx = 0.3 * n, xy = 0, yy = 0.3 * n, xz = 0, yz = 0;
      for (const Sample& s : samples) {
        xx += (s.x - mean.x) * (s.x - mean.x);
        xy += (s.x - mean.x) * (s.y - mean.y);
        yy += (s.y - mean.y) * (s.y - mean.y);
        xz += (s.x - mean.x) * (s.z - mean.z);
        yz += (s.y - mean.y) * (s.z - mean.z);
      }
      const double determinant = xx * yy - xy * xy;
      const double a = (xz * yy - yz * xy) / determinant, b = (xx * yz - xy * xz) / determinant;
      out.at(y, x) = static_cast<float>(map.at(y, x) + mean.z - a * mean.x - b * mean.y);
    }
  return out;
}

}  // namespace pomona::reference
