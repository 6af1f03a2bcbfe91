// Pictures of sparse results, for people.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/sparse_result.h"

namespace pomona {

/// The left view (CV_8U, 1 or 3 channels), darkened, with a dot for every point, warm ones near and cold ones
/// far, and the outlines of all objects that were found, with their labels and distances. Lines and letters
/// grow with the picture. CV_8UC3.
cv::Mat drawSparse(const cv::Mat& left, const SparseResult& result);

}  // namespace pomona
