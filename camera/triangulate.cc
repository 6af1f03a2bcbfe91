#include "camera/triangulate.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace pomona {
namespace {

void requireSide(const char* name, int calibrated, int given) {
  if (calibrated != 0 && calibrated != given)
    throw std::invalid_argument("calibration " + std::string(name) + " is " + std::to_string(calibrated) +
                                "; the disparity map's is " + std::to_string(given));
}

}  // namespace

double depthAt(double disparity_px, const StereoCalibration& calibration) {
  const double parallax_px = disparity_px + calibration.doffs_px;
  return parallax_px > 0 ? calibration.focal_px * calibration.baseline_m / parallax_px
                         : std::numeric_limits<double>::quiet_NaN();
}

cv::Vec3d pointAt(double x, double y, double depth_m, const StereoCalibration& calibration) {
  const double scale = depth_m / calibration.focal_px;
  return {(x - calibration.cx_px) * scale, (y - calibration.cy_px) * scale, depth_m};
}

void requireMatching(const cv::Mat& disparity, const StereoCalibration& calibration) {
  calibration.validate();
  if (disparity.type() != CV_32FC1)
    throw std::invalid_argument("disparity is " + cv::typeToString(disparity.type()) + "; allowed: CV_32FC1");
  requireSide("width", calibration.width, disparity.cols);
  requireSide("height", calibration.height, disparity.rows);
}

cv::Mat depthFromDisparity(const cv::Mat& disparity, const StereoCalibration& calibration) {
  requireMatching(disparity, calibration);
  cv::Mat depth(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y) {
    const float* d = disparity.ptr<float>(y);
    float* z = depth.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x) z[x] = static_cast<float>(depthAt(d[x], calibration));
  }
  return depth;
}

}  // namespace pomona
