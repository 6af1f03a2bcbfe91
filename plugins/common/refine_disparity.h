// Disparities of keypoints to a fraction of a pixel, from the pixels themselves.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

struct RefineOptions {
  int radius_px = 5;             ///< of the square window that is registered, 1..50
  float max_step_px = 1;         ///< how far the result may be from the first guess
  float min_correlation = 0.8f;  ///< of the two windows, -1..1
};

struct RefinedDisparity {
  bool ok = false;
  float disparity_px = 0;
  float sigma_px = 0;     ///< by what the windows still differ, and by the gradients that hold them
  float correlation = 0;  ///< zero-mean, normalised
};

/// Registers the window around `left_px` along its row (Lucas & Kanade 1981, in one dimension, without the
/// windows' means), beginning at `disparity_px`. `left`, `right`: CV_8UC1 of one size. Not ok where a window
/// leaves a view, has no gradient to go by, or ends where `options` do not allow.
RefinedDisparity refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Point2f left_px,
                                 float disparity_px, const RefineOptions& options = {});

}  // namespace pomona
