// OpenCV's semi-global matcher, set up so that the comparison is fair.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// cv::StereoSGBM in MODE_HH (8 paths, whole image): blockSize 3, P1 8*9, P2 32*9, disp12MaxDiff 1,
/// uniquenessRatio 10, speckles below 100 pixels (range 2) removed, preFilterCap 63; on 8-bit gray. Both
/// views are extended by `num_disparities` columns on the left, because the matcher leaves that band
/// unmatched. Returns CV_32F, NaN where unmatched.
cv::Mat matchWithOpenCv(const cv::Mat& left, const cv::Mat& right, int num_disparities);

/// Fills each hole with the smaller, so farther, of the nearest disparities left and right of it in its row:
/// what is hidden in one view is background. Rows without any disparity take the row above, else below.
void fillRowsFromBackground(cv::Mat& disparity);

}  // namespace pomona
