#include "baselines/asw_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "baselines/kernels.h"
#include "core/parallel.h"

namespace pomona {
namespace {

/// IEC 61966-2-1: the light that an sRGB value in 0 .. 1 stands for.
double linearFromSrgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// CIE 15: the cube root, continued by its tangent near 0.
double labCurve(double t) {
  constexpr double kJoint = 6.0 / 29;
  return t > kJoint * kJoint * kJoint ? std::cbrt(t) : t / (3 * kJoint * kJoint) + 4.0 / 29;
}

template <typename T>
std::array<float, 3> bgrAt(const cv::Mat& image, int y, int x, double scale) {
  const int channels = image.channels();
  const T* pixel = image.ptr<T>(y) + x * channels;
  std::array<float, 3> bgr;
  for (int c = 0; c < 3; ++c)
    bgr[static_cast<std::size_t>(c)] = static_cast<float>(scale * pixel[channels == 1 ? 0 : c]);
  return bgr;
}

}  // namespace

std::array<float, 3> labFromBgr(const std::array<float, 3>& bgr) {
  const double b = linearFromSrgb(bgr[0] / 255.0), g = linearFromSrgb(bgr[1] / 255.0),
               r = linearFromSrgb(bgr[2] / 255.0);
  // Rows of the sRGB to XYZ matrix, each divided by the white point's component: white gives 1, 1, 1.
  const double x = labCurve((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = labCurve(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = labCurve((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {static_cast<float>(116 * y - 16), static_cast<float>(500 * (x - y)),
          static_cast<float>(200 * (y - z))};
}

void FloatPlane::resize(int width, int height, int margin, float outside) {
  margin_ = margin;
  const int padded = (width + kAswBlock - 1) / kAswBlock * kAswBlock + 2 * margin;
  image_.resize(padded, height);
  for (int y = 0; y < height; ++y) std::fill_n(image_.row(y), padded, outside);
}

AswView::AswView(const cv::Mat& image, double scale, int margin, int threads)
    : width(image.cols), height(image.rows) {
  for (std::size_t c = 0; c < 3; ++c) {
    bgr[c].resize(width, height, margin, 0);
    lab[c].resize(width, height, margin, c == 0 ? std::numeric_limits<float>::infinity() : 0);
  }
  parallelStrips(threads, height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const std::array<float, 3> color = image.depth() == CV_8U ? bgrAt<std::uint8_t>(image, y, x, scale)
                                                                  : bgrAt<std::uint16_t>(image, y, x, scale);
        const std::array<float, 3> converted = labFromBgr(color);
        for (std::size_t c = 0; c < 3; ++c) {
          bgr[c].row(y)[x] = color[c];
          lab[c].row(y)[x] = converted[c];
        }
      }
  });
}

}  // namespace pomona
