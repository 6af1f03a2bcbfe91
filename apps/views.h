// Views for people to look at.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// CV_8UC3 for display, from 8 or 16 bits and 1 or 3 channels.
cv::Mat toBgr8(const cv::Mat& image);

}  // namespace pomona
