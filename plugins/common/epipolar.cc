#include "plugins/common/epipolar.h"

#include <cmath>

namespace pomona {

cv::Matx33d essentialMatrix(const StereoCalibration& calibration) {
  const double t = calibration.baseline_m;
  return {0, 0, 0, 0, 0, -t, 0, t, 0};
}

cv::Matx33d fundamentalMatrix(const StereoCalibration& calibration) {
  const double f = calibration.focal_px;
  const auto cameraMatrix = [&](double cx_px) {
    return cv::Matx33d(f, 0, cx_px, 0, f, calibration.cy_px, 0, 0, 1);
  };
  const cv::Matx33d left = cameraMatrix(calibration.cx_px).inv();
  const cv::Matx33d right = cameraMatrix(calibration.cx_px + calibration.doffs_px).inv();
  return left.t() * essentialMatrix(calibration) * right;
}

double epipolarDistance(const cv::Matx33d& fundamental, cv::Point2f left_px, cv::Point2f right_px) {
  const cv::Vec3d line = fundamental.t() * cv::Vec3d(left_px.x, left_px.y, 1);
  return std::abs(line.dot(cv::Vec3d(right_px.x, right_px.y, 1))) / std::hypot(line[0], line[1]);
}

}  // namespace pomona
