// From disparity to points in the left camera's frame: metres, X right, Y down, Z forward.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/calibration.h"

namespace pomona {

/// Z = f B / (d + doffs); NaN where d is NaN or d + doffs <= 0 (at or beyond infinity).
double depthAt(double disparity_px, const StereoCalibration& calibration);

/// The point seen at pixel (x, y) of the left image: ((x - cx) Z / f, (y - cy) Z / f, Z). Principal points
/// count pixel centres as integers.
cv::Vec3d pointAt(double x, double y, double depth_m, const StereoCalibration& calibration);

/// Throws std::invalid_argument unless `calibration` is valid and `disparity` is CV_32F and of the size it
/// belongs to: a focal length of one image size yields wrong depths for any other.
void requireMatching(const cv::Mat& disparity, const StereoCalibration& calibration);

}  // namespace pomona
