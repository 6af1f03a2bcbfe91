#include <cmath>
#include <limits>

#include "pomona/rig.h"

namespace pomona {
namespace {

cv::Vec2d polynomial(const std::array<double, 8>& k, const cv::Vec2d& direction) {
  const double x = direction[0], y = direction[1], r2 = x * x + y * y;
  const double radial =
      (1 + ((k[4] * r2 + k[1]) * r2 + k[0]) * r2) / (1 + ((k[7] * r2 + k[6]) * r2 + k[5]) * r2);
  return {x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x),
          y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y};
}

cv::Vec2d fisheye(const std::array<double, 8>& k, const cv::Vec2d& direction) {
  const double r = std::hypot(direction[0], direction[1]);
  if (r == 0) return direction;
  const double t = std::atan(r), t2 = t * t;
  const double scale = t * (1 + (((k[3] * t2 + k[2]) * t2 + k[1]) * t2 + k[0]) * t2) / r;
  return direction * scale;
}

}  // namespace

cv::Vec2d CameraModel::pixelOf(const cv::Vec2d& direction) const {
  const cv::Vec2d bent = distortion_model == DistortionModel::kFisheye ? fisheye(distortion, direction)
                                                                       : polynomial(distortion, direction);
  return {fx_px * bent[0] + cx_px, fy_px * bent[1] + cy_px};
}

cv::Vec2d CameraModel::directionOf(const cv::Vec2d& pixel) const {
  // Newton's method with a Jacobian by central differences.
  constexpr int kMostSteps = 30;
  constexpr double kSmallestStep = 1e-9, kDifference = 1e-6;
  cv::Vec2d direction((pixel[0] - cx_px) / fx_px, (pixel[1] - cy_px) / fy_px);
  for (int i = 0; i < kMostSteps; ++i) {
    const cv::Vec2d off = pixelOf(direction) - pixel;
    const cv::Vec2d dx(kDifference, 0), dy(0, kDifference);
    const cv::Vec2d jx = (pixelOf(direction + dx) - pixelOf(direction - dx)) / (2 * kDifference);
    const cv::Vec2d jy = (pixelOf(direction + dy) - pixelOf(direction - dy)) / (2 * kDifference);
    const double determinant = jx[0] * jy[1] - jy[0] * jx[1];
    if (!(determinant > 0)) break;  // beyond the fold of the model, or not finite
    const cv::Vec2d step((jy[1] * off[0] - jy[0] * off[1]) / determinant,
                         (jx[0] * off[1] - jx[1] * off[0]) / determinant);
    direction -= step;
    if (cv::norm(step) < kSmallestStep) return direction;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan};
}

}  // namespace pomona
