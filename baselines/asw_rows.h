// The costs of adaptive support weights, row by row.
#pragma once

#include <memory>
#include <vector>

#include "baselines/asw.h"
#include "baselines/asw_views.h"
#include "baselines/kernels.h"

namespace pomona {

/// A pair, and what all strips of rows share.
struct AswPair {
  AswView left, right;
  AswOptions options;
  SearchRange range;
  const AswKernels& kernels;
  std::vector<float> log_proximity;  ///< binary logarithms of every tap of a whole window, row by row

  AswPair(const cv::Mat& left_image, const cv::Mat& right_image, const AswOptions& options, SearchRange range,
          const AswKernels& kernels, int threads);

  int width() const { return left.width; }
  int paddedWidth() const { return (left.width + kAswBlock - 1) / kAswBlock * kAswBlock; }
  int windowSide() const { return 2 * options.radius + 1; }
  int taps() const { return windowSide() * windowSide(); }
  /// The searched disparities in whole groups.
  int groups() const { return (range.count + kAswDisparities - 1) / kAswDisparities; }
};

/// The costs of rows first_row, first_row + 1, ... `pair` must outlive them.
std::unique_ptr<CostRows> aswRows(const AswPair& pair, int first_row);

}  // namespace pomona
