// What sparse-feature stereo finds: ranged points, and objects it recognised.
//
// Pixels are those of the rectified views, whole at their centres. Frame: the left camera's (rectified),
// metres, X right, Y down, Z forward. Standard deviations are of one sigma.
#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace pomona {

/// A point seen in both views.
struct SparsePoint {
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  int object = -1;  ///< the one of SparseResult::objects it belongs to; -1: none
  cv::Point2f left_px, right_px;
  float disparity_px = kUnknown;  ///< as Z is computed from it, in most cases left_px.x - right_px.x
  float sigma_px = kUnknown;      ///< of the disparity
  cv::Point3f point_m{kUnknown, kUnknown, kUnknown};
  float sigma_z_m = kUnknown;
};

/// An object that was looked for, whether or not it was found.
struct SparseObject {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string label;
  /// Why it was not found or could not be ranged, e.g. "3 of at least 8 matches agree"; empty if it was.
  std::string why_not;
  bool found() const { return why_not.empty(); }

  std::vector<cv::Point2f> outline_px;  ///< corners in the left view, in order; empty if unknown
  cv::Rect2f box_px;                    ///< around it in the left view; empty if unknown
  cv::Point3d point_m{kUnknown, kUnknown, kUnknown};
  double distance_m = kUnknown;   ///< of point_m from the left camera's centre, along the line of sight
  double sigma_m = kUnknown;      ///< of the distance
  double bearing_deg = kUnknown;  ///< atan2(X, Z): to the right of the optical axis
  int support = 0;                ///< how many points (or pixels) agree on the distance
};

/// A figure about the run, for tables: {"features left", 4516, ""}, {"matching", 12.3, "ms"}.
struct SparseFigure {
  std::string name;
  double value = 0;
  std::string unit;  ///< empty for counts
};

/// A picture that explains the result, e.g. a map seen from above. CV_8U, 1 or 3 channels (BGR).
struct SparsePicture {
  std::string name;  ///< lower-case letters, digits and hyphens: it becomes part of a file's name
  cv::Mat image;
};

struct SparseResult {
  std::vector<SparsePoint> points;
  std::vector<SparseObject> objects;
  std::vector<SparseFigure> figures;
  std::vector<SparsePicture> pictures;
};

}  // namespace pomona
