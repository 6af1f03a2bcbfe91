// Sum of squared differences over a square window.
#pragma once

#include <opencv2/core.hpp>

#include "baselines/winner.h"

namespace pomona {

/// Cost: the sum of (left(p) - right(p - d))^2 over the window and all channels, summed in
/// whole numbers and then rounded to float. The views have equal
/// size and type, CV_8U or CV_16U with 1 or 3 channels. `radius`: the window's side is 2 radius + 1; 0 to
/// kLargestWindowRadius, or std::invalid_argument is thrown.
WindowMaps matchSsd(const cv::Mat& left, const cv::Mat& right, int radius, SearchRange range,
                    WinnerPosition position, int threads);

}  // namespace pomona
