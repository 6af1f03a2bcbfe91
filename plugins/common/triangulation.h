// From matched pixels of a rectified pair to points in metres.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/calibration.h"
#include "pomona/sparse_result.h"

namespace pomona {

/// The point that `left_px` and `right_px` show: Z = f B / (d + doffs), d = x_left - x_right, and its
/// standard deviation Z^2 / (f B) sigma_px. Without a point in front of the cameras, point_m is NaN.
SparsePoint triangulate(const StereoCalibration& calibration, cv::Point2f left_px, cv::Point2f right_px,
                        float sigma_px, int object = -1);

/// Its distance from the left camera's centre, along the line of sight.
double distanceOf(const cv::Point3d& point_m);
/// atan2(X, Z) in degrees: to the right of the optical axis.
double bearingOf(const cv::Point3d& point_m);

}  // namespace pomona
