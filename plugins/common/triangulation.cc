#include "plugins/common/triangulation.h"

#include <cmath>

namespace pomona {

SparsePoint triangulate(const StereoCalibration& calibration, cv::Point2f left_px, cv::Point2f right_px,
                        float sigma_px, int object) {
  SparsePoint point;
  point.object = object;
  point.left_px = left_px;
  point.right_px = right_px;
  point.disparity_px = left_px.x - right_px.x;
  point.sigma_px = sigma_px;
  const double shift_px = point.disparity_px + calibration.doffs_px;
  if (!(shift_px > 0)) return point;
  const double z_m = calibration.focal_px * calibration.baseline_m / shift_px;
  const double m_per_px = z_m / calibration.focal_px;
  point.point_m = cv::Point3d((left_px.x - calibration.cx_px) * m_per_px,
                              (left_px.y - calibration.cy_px) * m_per_px, z_m);
  point.sigma_z_m = static_cast<float>(z_m / shift_px * sigma_px);
  return point;
}

double distanceOf(const cv::Point3d& point_m) {
  return cv::norm(point_m);
}

double bearingOf(const cv::Point3d& point_m) {
  return std::atan2(point_m.x, point_m.z) * 180 / CV_PI;
}

}  // namespace pomona
