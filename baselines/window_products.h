// Sums over square windows that SSD and NCC are made of. All are whole numbers and exact. A view continues
// beyond its border with its nearest pixel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "baselines/winner.h"
#include "core/image.h"

namespace pomona {

/// A view with interleaved channels. `width` counts pixels; `stride` counts elements.
template <typename T>
struct PixelView {
  const T* data;
  int width, height, channels;
  std::ptrdiff_t stride;

  /// The pixel nearest to (x, y).
  const T* nearest(int y, int x) const {
    return data + std::clamp(y, 0, height - 1) * stride + std::clamp(x, 0, width - 1) * channels;
  }
};

/// Wide enough for the sum of squares over the largest window, of three channels.
template <typename T>
using WindowSum = std::conditional_t<sizeof(T) == 1, std::uint32_t, std::uint64_t>;
inline constexpr int kLargestWindowRadius = 31;

/// For every pixel: the sum of each channel over the window around it, and the sum of all squares.
template <typename T>
struct WindowMoments {
  std::vector<Image<WindowSum<T>>> sum;
  Image<WindowSum<T>> squares;

  WindowMoments(const PixelView<T>& view, int radius);
};

/// sum over the window and the channels of left(x + u) right(x + u - d), for one row after the other.
template <typename T>
class WindowProducts {
 public:
  using Sum = WindowSum<T>;

  WindowProducts(const PixelView<T>& left, const PixelView<T>& right, int radius, SearchRange range,
                 int first_row);

  /// Calls `visit(x, sums)` for every pixel of the next row, with sums[i] for the disparity min + i.
  template <typename Visit>
  void nextRow(Visit visit) {
    advance();
    const std::size_t count = static_cast<std::size_t>(range_.count);
    std::fill(window_.begin(), window_.end(), Sum{0});
    for (int u = 0; u < 2 * radius_; ++u) add(column(u));
    for (int x = 0; x < left_.width; ++x) {
      add(column(x + 2 * radius_));
      visit(x, static_cast<const Sum*>(window_.data()));
      const Sum* leaving = column(x);
      for (std::size_t i = 0; i < count; ++i) window_[i] -= leaving[i];
    }
  }

 private:
  /// Of the column x = u - radius: one sum over the window's rows per disparity.
  Sum* column(int u) { return columns_.data() + static_cast<std::size_t>(u) * window_.size(); }
  void add(const Sum* entering) {
    for (std::size_t i = 0; i < window_.size(); ++i) window_[i] += entering[i];
  }
  void advance();
  /// Adds the products of image row `y` to the column sums, or takes them away: modulo 2^n they return to the
  /// same values.
  template <bool kAdd>
  void accumulate(int y);

  PixelView<T> left_, right_;
  int radius_;
  SearchRange range_;
  int y_;                     // the row to come
  std::vector<Sum> columns_;  // of the rows y - radius - 1 to y + radius - 1
  std::vector<Sum> window_;
  std::vector<Sum> mirrored_;  // a right row from the last column to the first, so that disparities ascend
};

/// A pair and its moments: what all strips of rows share.
template <typename T>
struct WindowViews {
  PixelView<T> left, right;
  WindowMoments<T> left_moments, right_moments;

  WindowViews(const cv::Mat& left_image, const cv::Mat& right_image, int radius)
      : left(viewOf(left_image)),
        right(viewOf(right_image)),
        left_moments(left, radius),
        right_moments(right, radius) {}

 private:
  static PixelView<T> viewOf(const cv::Mat& image) {
    return {image.ptr<T>(), image.cols, image.rows, image.channels(),
            static_cast<std::ptrdiff_t>(image.step1())};
  }
};

/// Matches by the costs that Rows<T>(views, radius, range, first_row) computes.
template <template <typename> class Rows>
WindowMaps matchByProducts(const cv::Mat& left, const cv::Mat& right, int radius, SearchRange range,
                           WinnerPosition position, int threads) {
  if (radius < 0 || radius > kLargestWindowRadius)
    throw std::invalid_argument("radius is " + std::to_string(radius) + "; allowed: 0 to " +
                                std::to_string(kLargestWindowRadius));
  const auto match = [&]<typename T>(T) {
    const WindowViews<T> views(left, right, radius);
    return pickWinners(left.cols, left.rows, range, position, threads,
                       [&](int first_row) -> std::unique_ptr<CostRows> {
                         return std::make_unique<Rows<T>>(views, radius, range, first_row);
                       });
  };
  return left.depth() == CV_8U ? match(std::uint8_t{}) : match(std::uint16_t{});
}

}  // namespace pomona
