// What all measures share: the pixels that count, and shares that may be of nothing.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>

namespace pomona {

/// part / whole, NaN if there is no whole.
inline double ratio(double part, std::int64_t whole) {
  return whole > 0 ? part / static_cast<double>(whole) : std::numeric_limits<double>::quiet_NaN();
}

/// Throws std::invalid_argument, calling the map `what`, unless it has this size and type.
void requireLike(const char* what, const cv::Mat& map, cv::Size size, int type);

/// As above for a disparity map, its truth of the same size, and a mask, which may be empty.
void requireComparable(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask);

/// Calls `visit(y, x, t)`, row by row, for every pixel whose truth t is known and which the mask lets count.
template <typename Visit>
void forEachKnown(const cv::Mat& truth, const cv::Mat& mask, Visit visit) {
  constexpr std::uint8_t kCounts = 255;
  for (int y = 0; y < truth.rows; ++y) {
    const float* t = truth.ptr<float>(y);
    const std::uint8_t* m = mask.empty() ? nullptr : mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < truth.cols; ++x)
      if (std::isfinite(t[x]) && (!m || m[x] == kCounts)) visit(y, x, t[x]);
  }
}

}  // namespace pomona
