// How far away an object is, where, and how sure that is: what a robot asks of a disparity map.
//
// Frame: the left camera's (rectified), metres, X right, Y down, Z forward. Distances are from its centre of
// projection, along the line of sight, not along the optical axis. Standard deviations are of one sigma; the
// calibration counts as exact.
#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <string_view>
#include <variant>
#include <vector>

#include "pomona/calibration.h"
#include "pomona/disparity.h"

namespace pomona {

struct Circle {
  cv::Point2d center_px;
  double radius_px = 0;  ///< > 0
};
using Polygon = std::vector<cv::Point2d>;  ///< corners in order, at least three

/// Where in the left image the object is, as a detector says it: a box, a circle, a polygon, or a mask of the
/// image's size (CV_8U, not 0 inside). It should hold the object's visible part and may hold other things.
/// What reaches beyond the image is left out, but tells the object's size.
using Region = std::variant<cv::Rect, Circle, Polygon, cv::Mat>;

enum class ObjectShape {
  kSphere,   ///< about a sphere, as fruits are: its near side and its centre are measured
  kSurface,  ///< anything: the surface that most of the region shows
};

struct MeasureOptions {
  ObjectShape shape = ObjectShape::kSphere;
  /// Spheres: the radius to expect, and its standard deviation; 0: unknown, taken roughly from the region's
  /// size. It matters most for the centre of objects of which little is seen.
  double radius_m = 0, radius_sigma_m = 0;
  /// Fewer pixels of the object than this are too few to tell.
  int min_support_px = 40;
};

/// Why there is no measurement.
enum class MeasureFailure {
  kNone,       ///< there is one
  kOutside,    ///< the region holds no pixel of the image
  kUnmatched,  ///< hardly any of its pixels has a disparity
  kInfinite,   ///< the disparities there are those of infinity, or beyond
  kScattered,  ///< too few of the disparities agree on one surface
  kUnseen,     ///< those that do may be of something beside the object: most of the region was not measured
};
/// A line for people, e.g. "hardly any pixel of the region has a disparity".
std::string_view explain(MeasureFailure failure);

struct ObjectMeasurement {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  MeasureFailure failure = MeasureFailure::kUnmatched;  ///< unless kNone, all that is a double is NaN
  bool ok() const { return failure == MeasureFailure::kNone; }

  /// The near surface: for spheres where the line of sight to the centre enters, whether or not something
  /// hides that place; else the middle of what was seen.
  cv::Vec3d near_point_m = cv::Vec3d::all(kUnknown);
  double distance_m = kUnknown, distance_sigma_m = kUnknown;
  /// Spheres only.
  cv::Vec3d center_m = cv::Vec3d::all(kUnknown);
  double center_distance_m = kUnknown, center_sigma_m = kUnknown;
  double radius_m = kUnknown, radius_sigma_m = kUnknown;
  /// Direction of the near point: azimuth to the right and elevation upwards of the optical axis.
  double azimuth_rad = kUnknown, elevation_rad = kUnknown;

  int support_px = 0;        ///< pixels that agree with the measurement
  double support_share = 0;  ///< of the region's pixels in the image
};

/// Measures the object that `region` shows. `result` needs a disparity map; where other maps are empty, all
/// pixels count as measured and as equally sure. Leaves before the object, what is behind it and its
/// neighbours are told from it by how many pixels fit a sphere of about the region's size, and by how far
/// they are from its middle (docs/measuring.md). Throws std::invalid_argument for maps, a calibration, a
/// region or options that are not valid.
ObjectMeasurement measureObject(const StereoResult& result, const StereoCalibration& calibration,
                                const Region& region, const MeasureOptions& options = {});

/// One pixel's point.
struct PointMeasurement {
  MeasureFailure failure = MeasureFailure::kUnmatched;
  bool ok() const { return failure == MeasureFailure::kNone; }
  PixelState state = PixelState::kMasked;  ///< why, where kUnmatched; whether measured or filled, where ok()
  cv::Vec3d point_m = cv::Vec3d::all(ObjectMeasurement::kUnknown);
  double distance_m = ObjectMeasurement::kUnknown;
  double distance_sigma_m = ObjectMeasurement::kUnknown;  ///< from sigma_px; NaN if `result` has none
};

/// The point that pixel (round(x), round(y)) shows. Throws as measureObject() does.
PointMeasurement measurePoint(const StereoResult& result, const StereoCalibration& calibration, double x,
                              double y);

}  // namespace pomona
