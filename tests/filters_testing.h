// What the tests of the filters share: maps inside a poisoned frame, and random disparity maps.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include "core/image.h"
#include "reference/filters.h"

namespace pomona::testing {

using reference::kUnknown;
using reference::Map;

inline constexpr int kThreadCounts[] = {1, 2, 3, 7};
inline constexpr int kWidths[] = {1, 2, 7, 31, 33, 64, 65, 129};

/// A copy of a map, as a region of a larger image whose other pixels hold `poison`.
template <typename T>
class Framed {
 public:
  Framed(const Map<T>& map, int margin, T poison)
      : map_(map.width + 2 * margin, map.height + 2 * margin, poison),
        width_(map.width),
        height_(map.height),
        margin_(margin),
        poison_(poison) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) view().at(y, x) = map.at(y, x);
  }
  ImageView<T> view() { return {&map_.at(margin_, 0) + margin_, width_, height_, map_.width}; }
  Map<T> map() {
    Map<T> result(width_, height_, T{});
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) result.at(y, x) = view().at(y, x);
    return result;
  }
  bool frameIsIntact() const {
    for (int y = 0; y < map_.height; ++y)
      for (int x = 0; x < map_.width; ++x) {
        const bool inside = y >= margin_ && y < margin_ + height_ && x >= margin_ && x < margin_ + width_;
        if (!inside && map_.at(y, x) != poison_) return false;
      }
    return true;
  }

 private:
  Map<T> map_;
  int width_, height_, margin_;
  T poison_;
};

/// Bits compare equal: NaN equals NaN.
template <typename T>
::testing::AssertionResult sameBits(const Map<T>& a, const Map<T>& b) {
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      bool same = a.at(y, x) == b.at(y, x);
      if constexpr (std::is_same_v<T, float>)
        same = std::bit_cast<std::uint32_t>(a.at(y, x)) == std::bit_cast<std::uint32_t>(b.at(y, x));
      if (!same)
        return ::testing::AssertionFailure()
               << "at row " << y << ", column " << x << ": " << +a.at(y, x) << " is not " << +b.at(y, x);
    }
  return ::testing::AssertionSuccess();
}

/// Slanted surfaces with jumps between them, sixteenths of a pixel, a share of unknown pixels.
inline Map<float> randomDisparity(int width, int height, double unknown_share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<double> base, slope;
  for (int i = 0; i < 64; ++i) {
    base.push_back(share(random) * 20);
    slope.push_back(share(random) * 0.4 - 0.2);
  }
  Map<float> map(width, height, kUnknown);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (share(random) < unknown_share) continue;
      const int surface = (x / 11 + 3 * (y / 6)) % 64;
      const double noise = share(random) < 0.05 ? share(random) * 10 : 0;
      map.at(y, x) = static_cast<float>(std::round((base[surface] + slope[surface] * x + noise) * 16) / 16);
    }
  return map;
}

/// A guide with edges and noise; rows are a few bytes apart, and those bytes are not zero.
struct Guide {
  std::vector<std::uint8_t> bytes;
  GuideView view;

  Guide(int width, int height, int channels, std::uint32_t seed) {
    const int stride = width * channels + 5;
    bytes.assign(static_cast<std::size_t>(stride) * height, 170);
    std::mt19937 random(seed);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) {
          const int level = ((x / 9 + y / 5) % 3) * 70 + 20 * c + static_cast<int>(random() % 40);
          bytes[static_cast<std::size_t>(y) * stride + x * channels + c] = static_cast<std::uint8_t>(level);
        }
    view = {bytes.data(), width, height, channels, stride};
  }
};

inline Map<std::uint8_t> stateOf(const Map<float>& disparity) {
  Map<std::uint8_t> state(disparity.width, disparity.height,
                          static_cast<std::uint8_t>(PixelState::kMeasured));
  for (std::size_t i = 0; i < state.pixels.size(); ++i)
    if (std::isnan(disparity.pixels[i])) state.pixels[i] = static_cast<std::uint8_t>(PixelState::kAmbiguous);
  return state;
}

}  // namespace pomona::testing
