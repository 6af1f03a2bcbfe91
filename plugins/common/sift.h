// OpenCV's SIFT as the plugins use it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace pomona {

/// Gray as it is, or made of BGR. CV_8UC1; shares memory with `view` if it can.
cv::Mat grayOf(const cv::Mat& view);

/// Keypoints of one view, and a row of CV_8U descriptor for each.
struct ViewFeatures {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

struct SiftOptions {
  double contrast_threshold = 0.04;  ///< of Lowe 2004, as OpenCV counts it
  int max_features = 0;              ///< those of the strongest response; 0: all
};

/// Keypoints and 8-bit descriptors of `gray` (CV_8UC1). `mask`: empty, or CV_8U of its size, 0 where no
/// keypoint may be. An image with a side below 8 pixels has none.
ViewFeatures siftFeatures(const cv::Mat& gray, const cv::Mat& mask, const SiftOptions& options);

}  // namespace pomona
