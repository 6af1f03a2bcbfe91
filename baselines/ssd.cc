#include "baselines/ssd.h"

#include <limits>

#include "baselines/window_method.h"
#include "baselines/window_products.h"

namespace pomona {

std::span<const MethodInfo> ssdMethods();

namespace {

constexpr int kDefaultRadius = 4;

/// sum (l - r)^2 = sum l^2 + sum r^2 - 2 sum l r
template <typename T>
class SsdRows : public CostRows {
 public:
  SsdRows(const WindowViews<T>& views, int radius, SearchRange range, int first_row)
      : views_(views),
        range_(range),
        y_(first_row),
        products_(views.left, views.right, radius, range, first_row) {}

  void next(float* cost) override {
    const WindowSum<T>* left = views_.left_moments.squares.row(y_);
    const WindowSum<T>* right = views_.right_moments.squares.row(y_);
    const int width = views_.left.width;
    products_.nextRow([&](int x, const WindowSum<T>* products) {
      for (int i = 0; i < range_.count; ++i, ++cost) {
        const int column = x - range_.min - i;
        *cost = column >= 0 && column < width ? static_cast<float>(left[x] + right[column] - 2 * products[i])
                                              : std::numeric_limits<float>::infinity();
      }
    });
    ++y_;
  }

 private:
  const WindowViews<T>& views_;
  SearchRange range_;
  int y_;
  WindowProducts<T> products_;
};

class Ssd : public WindowMethod {
  WindowMaps match(const cv::Mat& left, const cv::Mat& right, SearchRange range, WinnerPosition position,
                   int threads) override {
    return matchSsd(left, right, kDefaultRadius, range, position, threads);
  }
};

constexpr MethodInfo kMethods[] = {
    {"ssd", "sum of squared differences, 9x9 window", [] { return std::unique_ptr<Method>(new Ssd); }},
};

}  // namespace

WindowMaps matchSsd(const cv::Mat& left, const cv::Mat& right, int radius, SearchRange range,
                    WinnerPosition position, int threads) {
  return matchByProducts<SsdRows>(left, right, radius, range, position, threads);
}

std::span<const MethodInfo> ssdMethods() {
  return kMethods;
}

}  // namespace pomona
