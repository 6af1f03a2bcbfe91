#include "camera/triangulate.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void requireSide(const char* name, int calibrated, int given) {
  if (calibrated != 0 && calibrated != given)
    throw std::invalid_argument("calibration " + std::string(name) + " is " + std::to_string(calibrated) +
                                "; the disparity map's is " + std::to_string(given));
}

// What a row needs of the calibration, in the maps' own precision. The loops over it have no branches, so
// that the compiler turns them into vectors: NaN and what is at infinity pass the same way as all else.
struct RowGeometry {
  explicit RowGeometry(const StereoCalibration& c)
      : focal_baseline_px_m(static_cast<float>(c.focal_px * c.baseline_m)),
        doffs_px(static_cast<float>(c.doffs_px)) {}

  float depth(float disparity_px) const {
    const float parallax_px = disparity_px + doffs_px;
    const float depth_m = focal_baseline_px_m / parallax_px;
    return parallax_px > 0 ? depth_m : kNan;
  }

  float focal_baseline_px_m, doffs_px;
};

void depthRow(const float* __restrict d, float* __restrict z, int width, RowGeometry g) {
  for (int x = 0; x < width; ++x) z[x] = g.depth(d[x]);
}

void sigmaRow(const float* __restrict d, const float* __restrict sigma_px, float* __restrict sigma_m,
              int width, RowGeometry g) {
  for (int x = 0; x < width; ++x) {
    const float z = g.depth(d[x]);
    sigma_m[x] = z * z / g.focal_baseline_px_m * sigma_px[x];
  }
}

void pointRow(const float* __restrict d, const float* __restrict slope_x, float slope_y,
              float* __restrict points, int width, RowGeometry g) {
  for (int x = 0; x < width; ++x) {
    const float z = g.depth(d[x]);
    points[3 * x] = slope_x[x] * z;
    points[3 * x + 1] = slope_y * z;
    points[3 * x + 2] = z;
  }
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
  for (int y = 0; y < disparity.rows; ++y)
    depthRow(disparity.ptr<float>(y), depth.ptr<float>(y), disparity.cols, RowGeometry(calibration));
  return depth;
}

cv::Mat depthSigma(const cv::Mat& disparity, const cv::Mat& sigma_px, const StereoCalibration& calibration) {
  requireMatching(disparity, calibration);
  if (sigma_px.type() != CV_32FC1 || sigma_px.size() != disparity.size())
    throw std::invalid_argument("sigma_px must be CV_32FC1 and of the disparity map's size");
  cv::Mat sigma_m(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y)
    sigmaRow(disparity.ptr<float>(y), sigma_px.ptr<float>(y), sigma_m.ptr<float>(y), disparity.cols,
             RowGeometry(calibration));
  return sigma_m;
}

cv::Mat pointsFromDisparity(const cv::Mat& disparity, const StereoCalibration& calibration) {
  requireMatching(disparity, calibration);
  cv::Mat1f slopes(1, disparity.cols);
  for (int x = 0; x < disparity.cols; ++x)
    slopes(x) = static_cast<float>((x - calibration.cx_px) / calibration.focal_px);
  cv::Mat points(disparity.size(), CV_32FC3);
  for (int y = 0; y < disparity.rows; ++y)
    pointRow(disparity.ptr<float>(y), slopes.ptr<float>(),
             static_cast<float>((y - calibration.cy_px) / calibration.focal_px), points.ptr<float>(y),
             disparity.cols, RowGeometry(calibration));
  return points;
}

}  // namespace pomona
