// How far away an object is whose features were seen in both views.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/disparity_plane.h"
#include "plugins/common/object_place.h"
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

/// Both write the object's outline and distance, or why there is none, into `object`.
void rangeByMean(const std::vector<SparsePoint>& points, const ObjectPlace& place, SparseObject& object);

/// What rangeByPlane() needs to know of a flat object, besides the views (CV_8U, 1 channel).
struct FlatObject {
  /// The points on it, if it lies there.
  std::function<std::vector<SparsePoint>(const ObjectPlace&)> points_at;
  /// Where it lies, if that is its surface: as locateOnPlane() has it.
  std::function<ObjectPlace(const DisparityPlane&)> place_on;
};

/// Ranges the object's middle, beginning with `place`, and returns its points. The surface says where the
/// object lies, more surely than matches alone, and its place what belongs to the surface: by turns, until
/// both stay. The standard deviation has both in it: that of the surface's disparity, and that of the middle
/// times the surface's slope.
std::vector<SparsePoint> rangeByPlane(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& rig,
                                      const FlatObject& flat, ObjectPlace place, SparseObject& object);

/// Disparities up to which a rig's views are searched: the calibration's, or a third of the width.
double largestDisparity(const StereoCalibration& rig, const cv::Mat& view);

}  // namespace pomona
