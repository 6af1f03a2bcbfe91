#include "baselines/ncc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "baselines/window_method.h"
#include "baselines/window_products.h"

namespace pomona {

std::span<const MethodInfo> nccMethods();

namespace {

constexpr int kDefaultRadius = 4;

/// With n pixels per window and S = sum: n^2 times the covariance is n S(l r) - S(l) S(r), n^2 times the
/// variance n S(l l) - S(l)^2, both summed over the channels.
template <typename T>
class NccRows : public CostRows {
 public:
  NccRows(const WindowViews<T>& views, int radius, SearchRange range, int first_row)
      : views_(views),
        range_(range),
        pixels_((2 * radius + 1) * (2 * radius + 1)),
        y_(first_row),
        products_(views.left, views.right, radius, range, first_row),
        right_scale_(static_cast<std::size_t>(views.left.width)) {}

  void next(float* cost) override {
    const int width = views_.left.width, channels = views_.left.channels;
    for (int x = 0; x < width; ++x)
      right_scale_[static_cast<std::size_t>(x)] = inverseDeviation(views_.right_moments, x);
    products_.nextRow([&](int x, const WindowSum<T>* products) {
      const double left_scale = inverseDeviation(views_.left_moments, x);
      for (int i = 0; i < range_.count; ++i, ++cost) {
        const int column = x - range_.min - i;
        if (column < 0 || column >= width) {
          *cost = std::numeric_limits<float>::infinity();
          continue;
        }
        std::int64_t covariance = pixels_ * static_cast<std::int64_t>(products[i]);
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
          covariance -= static_cast<std::int64_t>(views_.left_moments.sum[c].row(y_)[x]) *
                        static_cast<std::int64_t>(views_.right_moments.sum[c].row(y_)[column]);
        const double correlation =
            static_cast<double>(covariance) * left_scale * right_scale_[static_cast<std::size_t>(column)];
        *cost = static_cast<float>(std::max(0.0, 1 - correlation));
      }
    });
    ++y_;
  }

 private:
  /// 1 / sqrt(n^2 times the variance); 0 without texture.
  double inverseDeviation(const WindowMoments<T>& moments, int x) const {
    std::int64_t variance = pixels_ * static_cast<std::int64_t>(moments.squares.row(y_)[x]);
    for (const auto& plane : moments.sum) {
      const auto sum = static_cast<std::int64_t>(plane.row(y_)[x]);
      variance -= sum * sum;
    }
    return variance > 0 ? 1 / std::sqrt(static_cast<double>(variance)) : 0;
  }

  const WindowViews<T>& views_;
  SearchRange range_;
  std::int64_t pixels_;
  int y_;
  WindowProducts<T> products_;
  std::vector<double> right_scale_;
};

class Ncc : public WindowMethod {
  WindowMaps match(const cv::Mat& left, const cv::Mat& right, SearchRange range, WinnerPosition position,
                   int threads) override {
    return matchNcc(left, right, kDefaultRadius, range, position, threads);
  }
};

constexpr MethodInfo kMethods[] = {
    {"ncc", "normalised cross-correlation, 9x9 window", [] { return std::unique_ptr<Method>(new Ncc); }},
};

}  // namespace

WindowMaps matchNcc(const cv::Mat& left, const cv::Mat& right, int radius, SearchRange range,
                    WinnerPosition position, int threads) {
  return matchByProducts<NccRows>(left, right, radius, range, position, threads);
}

std::span<const MethodInfo> nccMethods() {
  return kMethods;
}

}  // namespace pomona
