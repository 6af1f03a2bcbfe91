// The geometry that matches of a rectified pair have to obey.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/calibration.h"

namespace pomona {

/// E with x_left^T E x_right = 0 for the directions (x, y, 1) in which the two cameras see one point; in
/// units of metres. E = [t]x for the right camera's centre t = (baseline, 0, 0), as the rectified axes are
/// parallel.
cv::Matx33d essentialMatrix(const StereoCalibration& calibration);

/// The same for pixels: F = K_left^-T E K_right^-1.
cv::Matx33d fundamentalMatrix(const StereoCalibration& calibration);

/// How far `right_px` is from the line on which F says that the partner of `left_px` lies: pixels, >= 0.
double epipolarDistance(const cv::Matx33d& fundamental, cv::Point2f left_px, cv::Point2f right_px);

}  // namespace pomona
