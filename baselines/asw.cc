#include "baselines/asw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "baselines/asw_views.h"
#include "baselines/kernels.h"
#include "baselines/window_method.h"

namespace pomona {

std::span<const MethodInfo> aswMethods();

namespace {

/// A pair, and what all strips of rows share.
struct AswPair {
  AswView left, right;
  AswOptions options;
  SearchRange range;
  const AswKernels& kernels;
  std::vector<float> log_proximity;  // of every tap of a whole window, row by row

  int width() const { return left.width; }
  int paddedWidth() const { return (left.width + kAswBlock - 1) / kAswBlock * kAswBlock; }
  int windowSide() const { return 2 * options.radius + 1; }
  int taps() const { return windowSide() * windowSide(); }
};

std::vector<float> logProximity(const AswOptions& options) {
  std::vector<float> table;
  for (int v = -options.radius; v <= options.radius; ++v)
    for (int u = -options.radius; u <= options.radius; ++u)
      table.push_back(static_cast<float>(-std::numbers::log2e * std::hypot(u, v) / options.proximity_gamma));
  return table;
}

/// The weights of all windows of one row of a view, one plane per tap, with columns of zeros on both sides.
class SupportRow {
 public:
  SupportRow(const AswPair& pair, int columns_before, int columns_after)
      : before_(columns_before),
        stride_(columns_before + pair.paddedWidth() + columns_after),
        weights_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(pair.taps())) {}

  /// Only the window rows first_row to last_row, relative to y, get their weights; they start with tap 0.
  void compute(const AswPair& pair, const AswView& view, int y, int first_row, int last_row) {
    AswSupport support;
    support.plane_stride = view.lab[0].stride();
    support.radius = pair.options.radius;
    support.first_row = first_row;
    support.last_row = last_row;
    support.log_proximity =
        &pair.log_proximity[static_cast<std::size_t>((first_row + support.radius) * pair.windowSide())];
    support.color_scale = static_cast<float>(std::numbers::log2e / pair.options.color_gamma);
    for (int x = 0; x < pair.width(); x += kAswBlock) {
      for (std::size_t c = 0; c < 3; ++c) support.lab[c] = view.lab[c].row(y) + x;
      pair.kernels.supportWeights(support, weights_.data() + before_ + x, stride_);
    }
  }
  const float* at(int x) const { return weights_.data() + before_ + x; }
  std::ptrdiff_t tapStride() const { return stride_; }

 private:
  int before_;
  std::ptrdiff_t stride_;
  std::vector<float> weights_;
};

/// The raw costs of the rows that the window covers, in a ring.
class RawCosts {
 public:
  explicit RawCosts(const AswPair& pair)
      : pair_(pair),
        stride_(pair.paddedWidth() + 2 * pair.options.radius),
        costs_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(pair.range.count) *
               static_cast<std::size_t>(pair.windowSide())) {}

  void compute(int y) {
    for (int i = 0; i < pair_.range.count; ++i) {
      const int d = pair_.range.min + i;
      const int begin = std::max(0, d), end = std::min(pair_.width(), pair_.width() + d);
      float* out = row(y, i) + pair_.options.radius;
      const float *l[3], *r[3];
      for (std::size_t c = 0; c < 3; ++c) {
        l[c] = pair_.left.bgr[c].row(y);
        r[c] = pair_.right.bgr[c].row(y) - d;
      }
      for (int x = begin; x < end; ++x) {
        const float sum =
            std::fabs(l[0][x] - r[0][x]) + std::fabs(l[1][x] - r[1][x]) + std::fabs(l[2][x] - r[2][x]);
        out[x] = sum < pair_.options.truncation ? sum : pair_.options.truncation;
      }
    }
  }
  /// Of the image row `y` and the i-th disparity; starts `radius` pixels before the view.
  float* row(int y, int i) {
    const auto slot = static_cast<std::size_t>(y % pair_.windowSide() * pair_.range.count + i);
    return costs_.data() + slot * static_cast<std::size_t>(stride_);
  }

 private:
  const AswPair& pair_;
  std::ptrdiff_t stride_;
  std::vector<float> costs_;
};

class AswRows : public CostRows {
 public:
  AswRows(const AswPair& pair, int first_row)
      : pair_(pair),
        y_(first_row),
        raw_ready_(std::max(0, first_row - pair.options.radius)),
        left_(pair, 0, 0),
        right_(pair, std::max(0, pair.range.min + pair.range.count), std::max(0, -pair.range.min)),
        raw_(pair) {}

  void next(float* cost) override {
    const int radius = pair_.options.radius;
    const int first_row = -std::min(radius, y_), last_row = std::min(radius, pair_.left.height - 1 - y_);
    for (; raw_ready_ <= y_ + last_row; ++raw_ready_) raw_.compute(raw_ready_);
    left_.compute(pair_, pair_.left, y_, first_row, last_row);
    right_.compute(pair_, pair_.right, y_, first_row, last_row);
    for (int x = 0; x < pair_.width(); x += kAswBlock)
      for (int i = 0; i < pair_.range.count; ++i) costsOfBlock(x, i, first_row, last_row, cost);
    ++y_;
  }

 private:
  void costsOfBlock(int x, int i, int first_row, int last_row, float* cost) {
    const int d = pair_.range.min + i, width = pair_.width();
    const int end = std::min(width, x + kAswBlock);
    const int first_match = std::max(x, d), end_match = std::min(end, width + d);
    float block_cost[kAswBlock];
    if (first_match < end_match) {
      const float* raw[2 * kLargestAswRadius + 1];
      for (int v = first_row; v <= last_row; ++v) raw[v - first_row] = raw_.row(y_ + v, i) + x;
      pair_.kernels.weightedCosts({.left_weight = left_.at(x),
                                   .right_weight = right_.at(x - d),
                                   .left_tap_stride = left_.tapStride(),
                                   .right_tap_stride = right_.tapStride(),
                                   .raw_cost = raw,
                                   .rows = last_row - first_row + 1,
                                   .columns = pair_.windowSide()},
                                  block_cost);
    }
    for (int column = x; column < end; ++column)
      cost[static_cast<std::ptrdiff_t>(column) * pair_.range.count + i] =
          column >= first_match && column < end_match ? block_cost[column - x]
                                                      : std::numeric_limits<float>::infinity();
  }

  const AswPair& pair_;
  int y_;
  int raw_ready_;  // the first row below the raw costs that are there
  SupportRow left_, right_;
  RawCosts raw_;
};

/// 16-bit views use as many bits as they hold: 10- and 12-bit cameras leave the top ones empty.
double scaleTo8Bits(const cv::Mat& left, const cv::Mat& right) {
  if (left.depth() == CV_8U) return 1;
  double largest = 255;
  for (const cv::Mat* image : {&left, &right}) {
    double most;
    cv::minMaxLoc(image->reshape(1), nullptr, &most);
    largest = std::max(largest, most);
  }
  return 256.0 / static_cast<double>(std::bit_ceil(static_cast<unsigned>(largest) + 1));
}

void requireUsable(const AswOptions& options) {
  if (options.radius < 1 || options.radius > kLargestAswRadius)
    throw std::invalid_argument("radius is " + std::to_string(options.radius) + "; allowed: 1 to " +
                                std::to_string(kLargestAswRadius));
  const std::pair<const char*, float> positive[] = {{"color_gamma", options.color_gamma},
                                                    {"proximity_gamma", options.proximity_gamma},
                                                    {"truncation", options.truncation}};
  for (const auto& [name, value] : positive)
    if (!(value > 0 && std::isfinite(value)))
      throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; allowed: above 0");
}

class Asw : public WindowMethod {
  WindowMaps match(const cv::Mat& left, const cv::Mat& right, SearchRange range, WinnerPosition position,
                   int threads) override {
    return matchAsw(left, right, {}, range, position, chooseIsa(""), threads);
  }
};

constexpr MethodInfo kMethods[] = {
    {"asw", "adaptive support weights (Yoon and Kweon 2006), 35x35 window",
     [] { return std::unique_ptr<Method>(new Asw); }},
};

}  // namespace

WindowMaps matchAsw(const cv::Mat& left, const cv::Mat& right, const AswOptions& options, SearchRange range,
                    WinnerPosition position, Isa isa, int threads) {
  requireUsable(options);
  const double scale = scaleTo8Bits(left, right);
  const AswPair pair{AswView(left, scale, options.radius, threads),
                     AswView(right, scale, options.radius, threads),
                     options,
                     range,
                     aswKernels(isa),
                     logProximity(options)};
  return pickWinners(
      left.cols, left.rows, range, position, threads,
      [&](int first_row) -> std::unique_ptr<CostRows> { return std::make_unique<AswRows>(pair, first_row); });
}

std::span<const MethodInfo> aswMethods() {
  return kMethods;
}

}  // namespace pomona
