// Textbook twins of pyramid/: slow, obvious, in double precision or exact integers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "pomona/pixel_state.h"

namespace pomona::reference {

/// A value for every (row, column).
struct Map {
  Map(int w, int h, double value = 0) : width(w), height(h), values(w * h, value) {}
  double& at(int y, int x) { return values[y * width + x]; }
  double at(int y, int x) const { return values[y * width + x]; }
  double clamped(int y, int x) const { return at(std::clamp(y, 0, height - 1), std::clamp(x, 0, width - 1)); }
  int width, height;
  std::vector<double> values;
};

/// Mean over the area of output pixel (y, x), rounded half up. Areas in units of 1/out_w by 1/out_h input
/// pixels.
inline std::int64_t areaMean(const std::function<std::int64_t(int, int)>& in, int width, int height,
                             int out_w, int out_h, int y, int x) {
  const auto overlap = [](std::int64_t cell, std::int64_t cell_size, std::int64_t box,
                          std::int64_t box_size) {
    return std::max<std::int64_t>(0, std::min((cell + 1) * cell_size, (box + 1) * box_size) -
                                         std::max(cell * cell_size, box * box_size));
  };
  std::int64_t sum = 0;
  for (int i = 0; i < height; ++i)
    for (int j = 0; j < width; ++j)
      sum += overlap(i, out_h, y, height) * overlap(j, out_w, x, width) * in(i, j);
  const std::int64_t area = static_cast<std::int64_t>(width) * height;
  return sum / area + (2 * (sum % area) >= area ? 1 : 0);
}

inline double keysKernel(double s) {
  const double a = -0.5;
  s = std::fabs(s);
  if (s <= 1) return (a + 2) * s * s * s - (a + 3) * s * s + 1;
  if (s < 2) return a * s * s * s - 5 * a * s * s + 8 * a * s - 4 * a;
  return 0;
}

inline double bicubic(const Map& in, int out_w, int out_h, int y, int x) {
  const double v = (y + 0.5) * in.height / out_h - 0.5, u = (x + 0.5) * in.width / out_w - 0.5;
  const int top = static_cast<int>(std::floor(v)), left = static_cast<int>(std::floor(u));
  double sum = 0, known_sum = 0, known_weight = 0;
  for (int i = top - 1; i <= top + 2; ++i)
    for (int j = left - 1; j <= left + 2; ++j) {
      const double value = in.clamped(i, j), weight = keysKernel(v - i) * keysKernel(u - j);
      sum += weight * value;
      if (std::isnan(value)) continue;
      known_sum += std::fabs(weight) * value;
      known_weight += std::fabs(weight);
    }
  if (!std::isnan(sum)) return sum;
  return known_weight > 1e-9 ? known_sum / known_weight : std::numeric_limits<double>::quiet_NaN();
}

constexpr double kBinomial[5] = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};

/// Burt & Adelson 1983, Eq. 1.
inline Map reduce(const Map& in) {
  Map out((in.width + 1) / 2, (in.height + 1) / 2);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int m = -2; m <= 2; ++m)
        for (int n = -2; n <= 2; ++n)
          out.at(y, x) += kBinomial[m + 2] * kBinomial[n + 2] * in.clamped(2 * y + m, 2 * x + n);
  return out;
}

/// Eq. 2: only terms whose source position is whole take part.
inline Map expand(const Map& in, int width, int height) {
  Map out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int m = -2; m <= 2; ++m)
        for (int n = -2; n <= 2; ++n)
          if ((y - m) % 2 == 0 && (x - n) % 2 == 0)
            out.at(y, x) += 4 * kBinomial[m + 2] * kBinomial[n + 2] * in.clamped((y - m) / 2, (x - n) / 2);
  return out;
}

inline std::vector<Map> gaussianPyramid(const Map& map, int levels) {
  std::vector<Map> result{map};
  while (static_cast<int>(result.size()) < levels && std::min(result.back().width, result.back().height) > 1)
    result.push_back(reduce(result.back()));
  return result;
}

inline std::vector<Map> laplacianPyramid(const Map& map, int levels) {
  std::vector<Map> result = gaussianPyramid(map, levels);
  for (std::size_t i = 0; i + 1 < result.size(); ++i) {
    const Map coarse = expand(result[i + 1], result[i].width, result[i].height);
    for (std::size_t k = 0; k < coarse.values.size(); ++k) result[i].values[k] -= coarse.values[k];
  }
  return result;
}

/// Hole filling as its header tells it, marching along every ray.
struct HoleFill {
  using Value = std::function<float(int, int)>;
  int width, height, channels, radius;
  std::function<int(int, int, int)> guide;  // (y, x, channel)
  Value right, coarse;
  float fallback;

  void run(std::vector<float>& disparity, std::vector<std::uint8_t>& state) const {
    const std::vector<float> d = disparity;
    const std::vector<std::uint8_t> s = state;
    const auto is = [&](int i, PixelState p) { return s[i] == static_cast<std::uint8_t>(p); };
    const auto masked = [&](int i) { return is(i, PixelState::kMasked); };
    const auto source = [&](int i) {
      return (is(i, PixelState::kMeasured) && !std::isnan(d[i])) || is(i, PixelState::kFilledPlane);
    };
    const auto hole = [&](int i) {
      return (s[i] >= 16 && !masked(i)) || (is(i, PixelState::kMeasured) && std::isnan(d[i]));
    };
    const auto filled = [&](int i) {
      const bool behind = is(i, PixelState::kOccluded) || is(i, PixelState::kOutOfRange);
      return static_cast<std::uint8_t>(behind ? PixelState::kFilledBackground
                                              : PixelState::kFilledInterpolated);
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int p = y * width + x;
        if (!hole(p)) continue;
        std::vector<std::pair<float, std::uint64_t>> possible;
        std::vector<float> all, row;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if (std::abs(dx) + std::abs(dy) != 1) continue;
            for (int k = 1; k <= radius; ++k) {
              const int u = x + k * dx, v = y + k * dy;
              if (u < 0 || v < 0 || u >= width || v >= height) break;
              if (!source(v * width + u)) continue;
              const float e = d[v * width + u];
              all.push_back(e);
              if (dy == 0) row.push_back(e);
              const double position = std::floor(static_cast<float>(x) - e + 0.5f);
              if (position < 0 || position >= width || !(right(y, static_cast<int>(position)) < e - 1.5f))
                possible.push_back({e, weight(y, x, v, u, k)});
              break;
            }
          }
        if (!possible.empty())
          disparity[p] = median(possible);
        else if (!all.empty())
          disparity[p] = row.empty() ? *std::min_element(all.begin(), all.end())
                                     : *std::min_element(row.begin(), row.end());
        else
          disparity[p] = coarse(y, x);
        if (!std::isnan(disparity[p]))
          state[p] = all.empty() ? static_cast<std::uint8_t>(PixelState::kFilledCoarse) : filled(p);
      }
    for (const bool along_row : {true, false}) {
      const std::vector<float> now = disparity;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const int p = y * width + x;
          if (masked(p) || !std::isnan(now[p])) continue;
          int nearest = std::numeric_limits<int>::max();
          for (int i = 0; i < (along_row ? width : height); ++i) {
            const int q = along_row ? y * width + i : i * width + x;
            const int distance = std::abs(i - (along_row ? x : y));
            if (masked(q) || std::isnan(now[q]) || distance > nearest) continue;
            disparity[p] = distance == nearest ? std::min(disparity[p], now[q]) : now[q];
            nearest = distance;
            state[p] = filled(p);
          }
        }
    }
    for (int p = 0; p < width * height; ++p)
      if (!masked(p) && std::isnan(disparity[p])) {
        disparity[p] = fallback;
        state[p] = filled(p);
      }
  }

 private:
  std::uint64_t weight(int y, int x, int v, int u, int steps) const {
    int difference = 0;
    for (int c = 0; c < channels; ++c) difference += std::abs(guide(y, x, c) - guide(v, u, c));
    const auto integer = [](double w) { return static_cast<std::uint64_t>(std::llround(w * 65535)); };
    return std::max<std::uint64_t>(
        1, integer(std::exp(-difference / (12.0 * channels))) * integer(std::exp(-steps / 30.0)) / 16);
  }
  static float median(std::vector<std::pair<float, std::uint64_t>> c) {
    std::sort(c.begin(), c.end());
    std::uint64_t total = 0, sum = 0;
    for (const auto& [value, weight] : c) total += weight;
    for (const auto& [value, weight] : c)
      if (2 * (sum += weight) >= total) return value;
    return c.back().first;
  }
};

/// 25 times what a gray value is above the mean of the 5x5 around it, 0 beyond +-limit.
inline int localResidual(const Map& gray, int y, int x, int limit) {
  int residual = static_cast<int>(25 * gray.at(y, x));
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) residual -= static_cast<int>(gray.clamped(y + dy, x + dx));
  return std::abs(residual) <= limit ? residual : 0;
}

/// The correlation of two views' residuals over the pixels (x, y) for which wanted(y, x), each at its
/// disparity.
inline double residualCorrelation(const Map& left, const Map& right, int limit,
                                  const std::function<bool(int, int)>& wanted,
                                  const std::function<int(int, int)>& disparity) {
  double products = 0, squares = 0;
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < left.width; ++x) {
      const int other = x - disparity(y, x), a = localResidual(left, y, x, limit);
      if (!wanted(y, x) || a == 0 || other < 0 || other >= right.width) continue;
      const int b = localResidual(right, y, other, limit);
      products += a * b;
      squares += b * b;
    }
  return squares == 0 ? 0 : products / std::sqrt(squares);
}

}  // namespace pomona::reference
