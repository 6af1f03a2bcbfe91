// Textbook twins of the filters: slow, obvious, written from the definitions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/image.h"
#include "pomona/pixel_state.h"

namespace pomona::reference {

/// A map in row-major order that knows its size.
template <typename T>
struct Map {
  int width, height;
  std::vector<T> pixels;

  Map(int w, int h, T value) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, value) {}
  T& at(int y, int x) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const T& at(int y, int x) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  bool contains(int y, int x) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

inline void leftRightCheck(Map<float>& disparity, Map<std::uint8_t>& state, const Map<float>& right,
                           float threshold, int min_disparity, int num_disparities) {
  const auto reject = [&](int y, int x, PixelState reason) {
    disparity.at(y, x) = kUnknown;
    state.at(y, x) = static_cast<std::uint8_t>(reason);
  };
  for (int y = 0; y < disparity.height; ++y)
    for (int x = 0; x < disparity.width; ++x) {
      const double d = disparity.at(y, x);
      if (state.at(y, x) != static_cast<std::uint8_t>(PixelState::kMeasured) || std::isnan(d)) continue;
      const double match = std::floor(x - d + 0.5);
      if (match < 0 || match >= disparity.width) {
        reject(y, x, PixelState::kOutOfRange);
        continue;
      }
      if (std::abs(d - right.at(y, static_cast<int>(match))) <= threshold) continue;
      bool visible = false;
      for (int e = min_disparity; e < min_disparity + num_disparities; ++e)
        if (right.contains(y, x - e) && std::abs(right.at(y, x - e) - e) <= std::max(threshold, 1.0f))
          visible = true;
      reject(y, x, visible ? PixelState::kMismatched : PixelState::kOccluded);
    }
}

/// Flood fill from every pixel not yet seen.
inline void removeSpeckles(Map<float>& disparity, Map<std::uint8_t>& state, int min_size, float max_step) {
  const Map<float> before = disparity;
  Map<char> seen(before.width, before.height, 0);
  for (int y = 0; y < before.height; ++y)
    for (int x = 0; x < before.width; ++x) {
      if (seen.at(y, x) || std::isnan(before.at(y, x))) continue;
      std::vector<std::pair<int, int>> region{{y, x}};
      seen.at(y, x) = 1;
      for (std::size_t i = 0; i < region.size(); ++i) {
        const auto [v, u] = region[i];
        const std::pair<int, int> neighbours[] = {{v - 1, u}, {v + 1, u}, {v, u - 1}, {v, u + 1}};
        for (const auto& [nv, nu] : neighbours)
          if (before.contains(nv, nu) && !seen.at(nv, nu) &&
              std::abs(before.at(nv, nu) - before.at(v, u)) <= max_step) {
            seen.at(nv, nu) = 1;
            region.emplace_back(nv, nu);
          }
      }
      if (static_cast<int>(region.size()) >= min_size) continue;
      for (const auto& [v, u] : region) {
        disparity.at(v, u) = kUnknown;
        state.at(v, u) = static_cast<std::uint8_t>(PixelState::kSpeckle);
      }
    }
}

inline Map<float> medianFilter(const Map<float>& in, int size) {
  Map<float> out(in.width, in.height, kUnknown);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      if (std::isnan(in.at(y, x))) continue;
      std::vector<float> known;
      for (int v = y - size / 2; v <= y + size / 2; ++v)
        for (int u = x - size / 2; u <= x + size / 2; ++u)
          if (in.contains(v, u) && !std::isnan(in.at(v, u))) known.push_back(in.at(v, u));
      std::sort(known.begin(), known.end());
      out.at(y, x) = known[(known.size() - 1) / 2];
    }
  return out;
}

/// One pass in double precision. `minimum_weight`: below this sum of weights a hole stays.
inline Map<float> jointBilateral(const Map<float>& in, GuideView guide, double sigma_space,
                                 double sigma_range, bool holes_only, double minimum_weight) {
  Map<float> out = in;
  const int radius = static_cast<int>(std::ceil(2 * sigma_space));
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      if (holes_only && !std::isnan(in.at(y, x))) continue;
      double sum = 0, weights = 0;
      for (int v = y - radius; v <= y + radius; ++v)
        for (int u = x - radius; u <= x + radius; ++u) {
          if (!in.contains(v, u) || std::isnan(in.at(v, u))) continue;
          double squares = 0;
          for (int c = 0; c < guide.channels; ++c) {
            const double difference = static_cast<double>(guide.row(v)[u * guide.channels + c]) -
                                      guide.row(y)[x * guide.channels + c];
            squares += difference * difference;
          }
          const double distance = (v - y) * (v - y) + (u - x) * (u - x);
          const double weight = std::exp(-distance / (2 * sigma_space * sigma_space)) *
                                std::exp(-squares / guide.channels / (2 * sigma_range * sigma_range));
          sum += weight * in.at(v, u);
          weights += weight;
        }
      out.at(y, x) = weights >= minimum_weight ? static_cast<float>(sum / weights) : kUnknown;
    }
  return out;
}

}  // namespace pomona::reference
