#include "baselines/asw_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace pomona {
namespace {

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

std::vector<float> logProximity(const AswOptions& options) {
  std::vector<float> table;
  for (int v = -options.radius; v <= options.radius; ++v)
    for (int u = -options.radius; u <= options.radius; ++u)
      table.push_back(static_cast<float>(-std::numbers::log2e * std::hypot(u, v) / options.proximity_gamma));
  return table;
}

/// The rows of a window around row y that lie inside the view, relative to y.
struct WindowRows {
  int first, last;
  int count() const { return last - first + 1; }
};

/// Writes the support weights of one block of pixels of a view, the first at (x, y).
void supportWeights(const AswPair& pair, const AswView& view, int x, int y, WindowRows rows, float* out,
                    std::ptrdiff_t tap_stride) {
  const int radius = pair.options.radius;
  AswSupport support;
  for (std::size_t c = 0; c < 3; ++c) support.lab[c] = view.lab[c].row(y) + x;
  support.plane_stride = view.lab[0].stride();
  support.radius = radius;
  support.first_row = rows.first;
  support.last_row = rows.last;
  support.log_proximity =
      &pair.log_proximity[static_cast<std::size_t>((rows.first + radius) * pair.windowSide())];
  support.color_scale = static_cast<float>(std::numbers::log2e / pair.options.color_gamma);
  pair.kernels.supportWeights(support, out, tap_stride);
}

/// The weights of all windows of one row of the right view: one plane per tap, with room on both sides for
/// the columns that disparities lead to outside the view.
class RightSupport {
 public:
  explicit RightSupport(const AswPair& pair)
      : pair_(pair),
        before_(std::max(0, pair.range.min + pair.groups() * kAswDisparities)),
        stride_(oddLines(before_ + pair.paddedWidth() + std::max(0, -pair.range.min))),
        weights_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(pair.taps())) {}

  void compute(int y, WindowRows rows) {
    for (int x = 0; x < pair_.width(); x += kAswBlock)
      supportWeights(pair_, pair_.right, x, y, rows, weights_.data() + before_ + x, stride_);
  }
  const float* at(int x) const { return weights_.data() + before_ + x; }
  std::ptrdiff_t tapStride() const { return stride_; }

 private:
  /// An odd number of cache lines: with a power of two, the taps of a pixel would compete for a few cache
  /// sets.
  static std::ptrdiff_t oddLines(int count) {
    constexpr int kLine = 16;
    return ((count + kLine - 1) / kLine | 1) * kLine;
  }

  const AswPair& pair_;
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
        costs_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(pair.windowSide()) *
               static_cast<std::size_t>(pair.groups() * kAswDisparities)) {}

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
  /// Of the image row `y` and the i-th disparity; starts `radius` pixels before the view, with zeros.
  float* row(int y, int i) {
    const int slot = y % pair_.windowSide() * pair_.groups() * kAswDisparities + i;
    return costs_.data() + slot * stride_;
  }
  /// From one disparity to the next.
  std::ptrdiff_t disparityStride() const { return stride_; }

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
        left_weights_(static_cast<std::size_t>(pair.taps()) * kAswBlock),
        right_(pair),
        raw_(pair) {}

  void next(float* cost) override {
    const int radius = pair_.options.radius;
    const WindowRows rows{-std::min(radius, y_), std::min(radius, pair_.left.height - 1 - y_)};
    for (; raw_ready_ <= y_ + rows.last; ++raw_ready_) raw_.compute(raw_ready_);
    right_.compute(y_, rows);
    for (int x = 0; x < pair_.width(); x += kAswBlock) {
      supportWeights(pair_, pair_.left, x, y_, rows, left_weights_.data(), kAswBlock);
      for (int group = 0; group < pair_.groups(); ++group)
        costsOfBlock(x, group * kAswDisparities, rows, cost);
    }
    ++y_;
  }

 private:
  /// One block of pixels, the first at x, and one group of disparities, the first the i-th.
  void costsOfBlock(int x, int i, WindowRows rows, float* cost) {
    const int d = pair_.range.min + i, width = pair_.width();
    const int end = std::min(width, x + kAswBlock);
    const auto inView = [&](int column, int disparity) {
      return column - disparity >= 0 && column - disparity < width;
    };
    float block_cost[kAswDisparities * kAswBlock];
    if (end - 1 - d >= 0 && x - (d + kAswDisparities - 1) < width) {  // some match of some pixel is in view
      const float* raw[2 * kLargestAswRadius + 1];
      for (int v = rows.first; v <= rows.last; ++v) raw[v - rows.first] = raw_.row(y_ + v, i) + x;
      pair_.kernels.weightedCosts({.left_weight = left_weights_.data(),
                                   .right_weight = right_.at(x - d),
                                   .right_tap_stride = right_.tapStride(),
                                   .raw_cost = raw,
                                   .raw_disparity_stride = raw_.disparityStride(),
                                   .rows = rows.count(),
                                   .columns = pair_.windowSide()},
                                  block_cost);
    }
    const int disparities = std::min(kAswDisparities, pair_.range.count - i);
    for (int column = x; column < end; ++column)
      for (int j = 0; j < disparities; ++j)
        cost[static_cast<std::ptrdiff_t>(column) * pair_.range.count + i + j] =
            inView(column, d + j) ? block_cost[j * kAswBlock + column - x]
                                  : std::numeric_limits<float>::infinity();
  }

  const AswPair& pair_;
  int y_;
  int raw_ready_;                    // the first row below the raw costs that are there
  std::vector<float> left_weights_;  // of one block, tap by tap
  RightSupport right_;
  RawCosts raw_;
};

}  // namespace

AswPair::AswPair(const cv::Mat& left_image, const cv::Mat& right_image, const AswOptions& asw_options,
                 SearchRange searched, const AswKernels& asw_kernels, int threads)
    : left(left_image, scaleTo8Bits(left_image, right_image), asw_options.radius, threads),
      right(right_image, scaleTo8Bits(left_image, right_image), asw_options.radius, threads),
      options(asw_options),
      range(searched),
      kernels(asw_kernels),
      log_proximity(logProximity(asw_options)) {}

std::unique_ptr<CostRows> aswRows(const AswPair& pair, int first_row) {
  return std::make_unique<AswRows>(pair, first_row);
}

}  // namespace pomona
