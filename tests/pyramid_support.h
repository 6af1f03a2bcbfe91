// What the tests of pyramid/ share: images inside poison, random maps, and the sweep over settings.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A width x height image of `channels` values a pixel, surrounded by poison on all four sides.
template <typename T>
class Padded {
 public:
  Padded(int width, int height, T poison, int channels = 1)
      : width_(width),
        height_(height),
        channels_(channels),
        stride_(width * channels + 2 * kMargin + 5),
        poison_(poison),
        values_((height + 2 * kMargin) * stride_, poison) {}

  T& at(int y, int x, int c = 0) { return values_[(y + kMargin) * stride_ + kMargin + x * channels_ + c]; }
  const T& at(int y, int x, int c = 0) const { return const_cast<Padded*>(this)->at(y, x, c); }
  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  ImageView<T> view() { return {&at(0, 0), width_ * channels_, height_, stride_}; }
  ImageView<const T> view() const { return {&at(0, 0), width_ * channels_, height_, stride_}; }
  GuideView guide() const requires std::is_same_v<T, std::uint8_t> {
    return {&at(0, 0), width_, height_, channels_, stride_};
  }
  bool poisonIntact() const {
    Padded clean(width_, height_, poison_, channels_);
    for (int y = 0; y < height_; ++y) std::memcpy(&clean.at(y, 0), &at(y, 0), width_ * channels_ * sizeof(T));
    return std::memcmp(clean.values_.data(), values_.data(), values_.size() * sizeof(T)) == 0;
  }
  template <typename F>
  Padded& fill(F value) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        for (int c = 0; c < channels_; ++c) at(y, x, c) = value(y, x, c);
    return *this;
  }
  bool sameBytes(const Padded& other) const {
    return values_.size() == other.values_.size() &&
           std::memcmp(values_.data(), other.values_.data(), values_.size() * sizeof(T)) == 0;
  }

 private:
  static constexpr int kMargin = 3;
  int width_, height_, channels_;
  std::ptrdiff_t stride_;
  T poison_;
  std::vector<T> values_;
};

/// Calls test(kernels, threads) for every usable instruction set and several thread counts.
template <typename F>
void forEachSetting(F test) {
  for (Isa isa : usableIsas())
    for (int threads : {1, 2, 3, 7}) {
      SCOPED_TRACE("isa " + std::string(name(isa)) + ", threads " + std::to_string(threads));
      test(pyramidKernels(isa), threads);
    }
}

inline std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace pomona
