// How far away an object is whose features were seen in both views.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pomona/calibration.h"
#include "pomona/sparse_result.h"

namespace pomona {

enum class ObjectRanging {
  /// The mean of the points, without those whose depth is off the mean by more than one standard deviation.
  kMean,
  /// A point on the plane of most points, after the views were aligned inside the outline
  /// (alignDisparityPlane()): for flat objects.
  kPlane,
};

/// Writes the object's place and distance, or why there is none, into `object`.
void rangeByMean(const std::vector<SparsePoint>& points, SparseObject& object);

/// `left`, `right`: CV_8U, 1 channel. `middle_px`: the left view's pixel whose point is meant;
/// object.outline_px: where the object is.
void rangeByPlane(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& rig,
                  const std::vector<SparsePoint>& points, const cv::Point2d& middle_px, SparseObject& object);

/// Disparities up to which a rig's views are searched: the calibration's, or a third of the width.
double largestDisparity(const StereoCalibration& rig, const cv::Mat& view);

}  // namespace pomona
