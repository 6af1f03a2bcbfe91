// How far a disparity map is from the ground truth.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

namespace pomona {

/// Over the pixels whose true disparity is known. A hole counts as bad, and is left out of the average error.
struct Score {
  std::size_t known_pixels = 0;
  double bad1_percent = 0;  ///< error above 1 px, or no disparity
  double bad2_percent = 0;  ///< error above 2 px, or no disparity
  double average_error_px = 0;
  double coverage_percent = 0;  ///< pixels with a disparity
};

/// Both maps CV_32F, NaN unknown, of equal size.
Score scoreAgainst(const cv::Mat& disparity, const cv::Mat& ground_truth);

}  // namespace pomona
