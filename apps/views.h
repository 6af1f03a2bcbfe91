// Views for people to look at, and for programs that want bytes.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// CV_8UC3 for display, from 8 or 16 bits and 1 or 3 channels.
cv::Mat toBgr8(const cv::Mat& image);

/// Makes 16-bit views 8-bit ones: both are divided by the power of two that lets the largest value fit.
void toBytes(cv::Mat& left, cv::Mat& right);

}  // namespace pomona
