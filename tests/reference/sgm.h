// Semi-global matching as the textbook has it: whole volumes, plain loops, 32-bit integers. Slow on purpose.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "core/image.h"
#include "pomona/options.h"

namespace pomona::reference {

template <typename T>
std::vector<std::uint64_t> census(ImageView<const T> image, MatchingCost cost) {
  const auto pixel = [&](int y, int x) {
    return image.at(std::clamp(y, 0, image.height - 1), std::clamp(x, 0, image.width - 1));
  };
  int rx = 2, ry = 2;
  if (cost == MatchingCost::kCensus7x7) rx = ry = 3;
  if (cost == MatchingCost::kCensus9x7 || cost == MatchingCost::kCenterSymmetricCensus9x7) rx = 4, ry = 3;
  const bool symmetric = cost == MatchingCost::kCenterSymmetricCensus9x7;
  std::vector<std::uint64_t> codes;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::uint64_t code = 0;
      for (int dy = -ry; dy <= ry; ++dy)
        for (int dx = -rx; dx <= rx; ++dx) {
          if (dx == 0 && dy == 0) continue;
          if (symmetric && (dy > 0 || (dy == 0 && dx > 0))) continue;
          const bool bit =
              symmetric ? pixel(y + dy, x + dx) < pixel(y - dy, x - dx) : pixel(y + dy, x + dx) < pixel(y, x);
          code = (code << 1) | static_cast<std::uint64_t>(bit);
        }
      codes.push_back(code);
    }
  return codes;
}

struct Match {  // -1: there is none
  std::vector<int> index, best, below, above, second, right_index, right_best, right_below, right_above;
};

/// `cost(y, x, d)`: matching cost of left (x, y) at disparity index d. `step(y, x, y2, x2)`: P2 between
/// neighbours.
struct Problem {
  int width, height, disparities, min_disparity, paths, p1;
  std::function<int(int y, int x, int d)> cost;
  std::function<int(int y, int x, int y2, int x2)> p2;
};

inline std::vector<int> aggregate(const Problem& p) {
  const auto at = [&](int y, int x, int d) {
    return (static_cast<std::size_t>(y) * p.width + x) * p.disparities + d;
  };
  const std::size_t volume = static_cast<std::size_t>(p.width) * p.height * p.disparities;
  std::vector<int> matching(volume), sum(volume, 0), path(volume);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      for (int d = 0; d < p.disparities; ++d) matching[at(y, x, d)] = p.cost(y, x, d);

  const int direction[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  for (int r = 0; r < p.paths; ++r) {
    const auto [dx, dy] = direction[r];
    for (int i = 0; i < p.height; ++i)
      for (int j = 0; j < p.width; ++j) {
        const int y = dy < 0 ? p.height - 1 - i : i, x = dx < 0 ? p.width - 1 - j : j;
        const int py = y - dy, px = x - dx;
        if (py < 0 || py >= p.height || px < 0 || px >= p.width) {
          for (int d = 0; d < p.disparities; ++d) path[at(y, x, d)] = matching[at(y, x, d)];
        } else {
          const int* before = &path[at(py, px, 0)];
          const int minimum = *std::min_element(before, before + p.disparities);
          for (int d = 0; d < p.disparities; ++d) {
            int v = std::min(before[d], minimum + p.p2(y, x, py, px));
            if (d > 0) v = std::min(v, before[d - 1] + p.p1);
            if (d + 1 < p.disparities) v = std::min(v, before[d + 1] + p.p1);
            path[at(y, x, d)] = matching[at(y, x, d)] + v - minimum;
          }
        }
      }
    for (std::size_t k = 0; k < volume; ++k) sum[k] += path[k];
  }
  return sum;
}

inline Match match(const Problem& p) {
  const std::vector<int> sum = aggregate(p);
  const auto s = [&](int y, int x, int d) {
    return sum[(static_cast<std::size_t>(y) * p.width + x) * p.disparities + d];
  };
  Match m;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      int b = 0;
      for (int d = 1; d < p.disparities; ++d)
        if (s(y, x, d) < s(y, x, b)) b = d;
      int second = -1;
      for (int d = 0; d < p.disparities; ++d)
        if (std::abs(d - b) > 1 && (second < 0 || s(y, x, d) < second)) second = s(y, x, d);
      m.index.push_back(b);
      m.best.push_back(s(y, x, b));
      m.below.push_back(s(y, x, std::max(b - 1, 0)));
      m.above.push_back(s(y, x, std::min(b + 1, p.disparities - 1)));
      m.second.push_back(second);

      int right = -1;
      for (int d = 0; d < p.disparities; ++d) {
        const int left_x = x + p.min_disparity + d;
        if (left_x < 0 || left_x >= p.width) continue;
        if (right < 0 || s(y, left_x, d) < s(y, x + p.min_disparity + right, right)) right = d;
      }
      m.right_index.push_back(right);
      const int from = x + p.min_disparity + right;
      const bool inner = right > 0 && right + 1 < p.disparities && from > 0 && from + 1 < p.width;
      m.right_best.push_back(right < 0 ? -1 : s(y, from, right));
      m.right_below.push_back(inner ? s(y, from - 1, right - 1) : -1);
      m.right_above.push_back(inner ? s(y, from + 1, right + 1) : -1);
    }
  return m;
}

inline int adaptedPenalty(const AggregationOptions& o, int step) {
  if (o.adaptation == PenaltyAdaptation::kInverseIntensity)
    return step == 0 ? o.p2 : std::max(o.p1, o.p2 / step);
  if (o.adaptation == PenaltyAdaptation::kSoftIntensity)
    return std::max(o.p2_min, static_cast<int>(std::floor(o.p2 / (1 + step / 10.0) + 1e-9)));
  return o.p2;
}

/// The whole matcher on census costs.
template <typename T>
Match matchCensus(ImageView<const T> left, ImageView<const T> right, ImageView<const std::uint8_t> guide,
                  MatchingCost cost, const AggregationOptions& o, int min_disparity, int disparities) {
  const std::vector<std::uint64_t> l = census(left, cost), r = census(right, cost);
  const int width = left.width;
  return match({width, left.height, disparities, min_disparity, o.paths, o.p1,
                [&](int y, int x, int d) {
                  const int from = std::clamp(x - min_disparity - d, 0, width - 1);
                  return std::popcount(l[y * width + x] ^ r[y * width + from]);
                },
                [&](int y, int x, int y2, int x2) {
                  return adaptedPenalty(o, std::abs(guide.at(y, x) - guide.at(y2, x2)));
                }});
}

}  // namespace pomona::reference
