#include "pomona/rig.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <stdexcept>

namespace pomona {
namespace {

constexpr int kLongestSide = 32'000;
constexpr double kLargestFocal_px = 1e6, kLargestCenter_px = 1e6, kLargestCoefficient = 1e4;

template <typename Value>
void require(bool good, const std::string& field, const Value& value, const std::string& allowed) {
  if (good) return;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << field << " is " << value << "; allowed: " << allowed;
  throw std::invalid_argument(message.str());
}

bool within(double value, double low, double high) {  // false for NaN
  return value >= low && value <= high;
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// A principal point far outside of the image belongs to another image size, or to none.
void validateCenter(const std::string& name, double cx_px, double cy_px, int width, int height) {
  const double reach_x = width > 0 ? width : kLargestCenter_px, reach_y = height > 0 ? height : reach_x;
  const std::string of = width > 0 ? " (of " + sizeText(width, height) + ")" : "";
  require(within(cx_px, -reach_x, 2 * reach_x), name + " cx", cx_px, "from -1 to 2 image widths" + of);
  require(within(cy_px, -reach_y, 2 * reach_y), name + " cy", cy_px, "from -1 to 2 image heights" + of);
}

void validateCamera(const std::string& name, const CameraModel& c) {
  require(within(c.width, 0, kLongestSide), name + " width", c.width, "0 (unknown) to 32000");
  require(within(c.height, 0, kLongestSide), name + " height", c.height, "0 (unknown) to 32000");
  require((c.width > 0) == (c.height > 0), name + " size", sizeText(c.width, c.height),
          "width and height, or neither (0x0, unknown)");
  for (const auto& [field, f] : {std::pair(" fx", c.fx_px), std::pair(" fy", c.fy_px)})
    require(f > 0 && f <= kLargestFocal_px, name + field, f, "a number above 0, up to 1000000 px");
  require(within(c.fx_px / c.fy_px, 0.5, 2), name + " fx / fy", c.fx_px / c.fy_px, "0.5 to 2");
  validateCenter(name, c.cx_px, c.cy_px, c.width, c.height);
  for (std::size_t i = 0; i < c.distortion.size(); ++i)
    require(within(c.distortion[i], -kLargestCoefficient, kLargestCoefficient),
            name + " distortion[" + std::to_string(i) + "]", c.distortion[i], "-10000 to 10000");
}

void validateRotation(const std::string& name, const cv::Matx33d& r) {
  constexpr double kTolerance = 1e-3;  // files carry as few as four decimals
  const cv::Matx33d product = r * r.t();
  for (int i = 0; i < 9; ++i) {
    const double wanted = i % 4 == 0 ? 1 : 0;
    require(std::abs(product.val[i] - wanted) <= kTolerance, name, cv::Mat(r).reshape(1, 1),
            "a rotation: rows of length 1 at right angles");
  }
  require(cv::determinant(r) > 0, name, cv::Mat(r).reshape(1, 1), "a rotation, not a reflection");
}

void validateArrangement(const cv::Matx33d& r, const cv::Vec3d& t) {
  constexpr double kCosineOf45Degrees = 0.7071;
  const double cosine = (r(0, 0) + r(1, 1) + r(2, 2) - 1) / 2;
  require(cosine >= kCosineOf45Degrees, "R", cv::Mat(r).reshape(1, 1),
          "cameras turned by at most 45 degrees against each other");
  const double length = cv::norm(t);
  require(std::isfinite(length) && length > 0, "T", t,
          "finite and not zero: the cameras are in different places");
  const cv::Vec3d right_m = -(r.t() * t);  // the right camera's place in the left camera's frame
  const double x = right_m[0], y = std::abs(right_m[1]), z = std::abs(right_m[2]);
  require(std::abs(x) >= y || y < z, "T", t,
          "cameras side by side; these are one above the other: turn the images by 90 degrees and calibrate "
          "anew");
  require(std::abs(x) >= z, "T", t, "cameras side by side; these are one behind the other");
  require(
      x > 0, "T", t,
      "T.x < 0, the right camera on the right; here left and right are exchanged, or T leads from right to "
      "left");
}

double near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance;
}

bool isIdentity(const cv::Matx33d& r) {
  return cv::norm(r, cv::Matx33d::eye(), cv::NORM_INF) <= 1e-9;
}

}  // namespace

bool CameraModel::isDistorted() const {
  // Without coefficients the fisheye model is no pinhole: its radius grows with the angle, not its tangent.
  return distortion_model == DistortionModel::kFisheye ||
         std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0; });
}

bool StereoRig::isRectified() const {
  const double tolerance_px = 1e-6 * left.fx_px;
  const bool same_lens =
      near(left.fx_px, left.fy_px, tolerance_px) && near(left.fx_px, right.fx_px, tolerance_px) &&
      near(left.fx_px, right.fy_px, tolerance_px) && near(left.cy_px, right.cy_px, tolerance_px);
  const double tolerance_m = 1e-9 * baselineM();
  return same_lens && !left.isDistorted() && !right.isDistorted() && isIdentity(right_from_left_rotation) &&
         near(right_from_left_m[1], 0, tolerance_m) && near(right_from_left_m[2], 0, tolerance_m);
}

void StereoRig::validate() const {
  validateCamera("left", left);
  validateCamera("right", right);
  require(left.width == right.width && left.height == right.height, "right size",
          sizeText(right.width, right.height), "the left camera's");
  require(left.distortion_model == right.distortion_model, "right distortion model", "another than the left",
          "one model for both cameras");
  validateRotation("R", right_from_left_rotation);
  validateArrangement(right_from_left_rotation, right_from_left_m);
  if (!rectification) return;
  validateRotation("left rectification", rectification->left_rotation);
  validateRotation("right rectification", rectification->right_rotation);
  const StereoCalibration& c = rectification->calibration;
  c.validate();
  validateCenter("left rectified", c.cx_px, c.cy_px, c.width, c.height);
  validateCenter("right rectified", c.cx_px + c.doffs_px, c.cy_px, c.width, c.height);
  const double stated_m = c.baseline_m;
  require(within(stated_m / baselineM(), 0.98, 1.02), "baseline of the rectification", stated_m,
          "the length of T; the file may mix units, or describe two rigs");
  const cv::Vec3d turned =
      rectification->right_rotation * right_from_left_m + cv::Vec3d(stated_m, 0, 0);  // should be 0
  require(cv::norm(turned) <= 0.05 * stated_m, "T turned by the right rectification",
          rectification->right_rotation * right_from_left_m,
          "(-baseline, 0, 0): the file may describe two rigs");
}

StereoRig rigOf(const StereoCalibration& calibration) {
  calibration.validate();
  StereoRig rig;
  rig.left.width = calibration.width;
  rig.left.height = calibration.height;
  rig.left.fx_px = rig.left.fy_px = calibration.focal_px;
  rig.left.cx_px = calibration.cx_px;
  rig.left.cy_px = calibration.cy_px;
  rig.right = rig.left;
  rig.right.cx_px += calibration.doffs_px;
  rig.right_from_left_m = {-calibration.baseline_m, 0, 0};
  rig.rectification = Rectification{.calibration = calibration};
  return rig;
}

namespace {

bool seesBorder(const CameraModel& camera, const cv::Matx33d& rotation, double cx_px,
                const StereoCalibration& c) {
  const cv::Matx33d back = rotation.t();
  const auto seen = [&](int x, int y) {
    const cv::Vec3d d = back * cv::Vec3d((x - cx_px) / c.focal_px, (y - c.cy_px) / c.focal_px, 1);
    const cv::Vec2d pixel = camera.pixelOf({d[0] / d[2], d[1] / d[2]});
    return d[2] > 0 && within(pixel[0], 0, camera.width - 1) && within(pixel[1], 0, camera.height - 1);
  };
  for (int x = 0; x < c.width; ++x)
    if (!seen(x, 0) || !seen(x, c.height - 1)) return false;
  for (int y = 0; y < c.height; ++y)
    if (!seen(0, y) || !seen(c.width - 1, y)) return false;
  return true;
}

// OpenCV looks at 9 x 9 points only, and leaves some pixels from outside: zooms in until there are none.
void zoomIn(const StereoRig& rig, Rectification& r) {
  constexpr double kStep = 1.001;
  constexpr int kMostSteps = 100;
  StereoCalibration& c = r.calibration;
  const auto clean = [&] {
    return seesBorder(rig.left, r.left_rotation, c.cx_px, c) &&
           seesBorder(rig.right, r.right_rotation, c.cx_px + c.doffs_px, c);
  };
  for (int i = 0; i < kMostSteps && !clean(); ++i) c.focal_px *= kStep;
}

Rectification bouguet(const StereoRig& rig) {
  const cv::Size size(rig.left.width, rig.left.height);
  const cv::Mat r(rig.right_from_left_rotation), t(rig.right_from_left_m);
  const auto coefficients = [](const CameraModel& c) {
    return cv::Mat(1, c.distortion_model == DistortionModel::kFisheye ? 4 : 8, CV_64F,
                   const_cast<double*>(c.distortion.data()))
        .clone();
  };
  cv::Mat r1, r2, p1, p2, q;
  if (rig.left.distortion_model == DistortionModel::kFisheye)
    cv::fisheye::stereoRectify(rig.left.matrix(), coefficients(rig.left), rig.right.matrix(),
                               coefficients(rig.right), size, r, t, r1, r2, p1, p2, q,
                               cv::CALIB_ZERO_DISPARITY, size, 0, 1);
  else
    cv::stereoRectify(rig.left.matrix(), coefficients(rig.left), rig.right.matrix(), coefficients(rig.right),
                      size, r, t, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 0, size);
  Rectification result{r1, r2, {}};
  StereoCalibration& c = result.calibration;
  c.focal_px = p1.at<double>(0, 0);
  c.cx_px = p1.at<double>(0, 2);
  c.cy_px = p1.at<double>(1, 2);
  c.doffs_px = p2.at<double>(0, 2) - c.cx_px;
  c.baseline_m = -p2.at<double>(0, 3) / p2.at<double>(0, 0);
  c.width = size.width;
  c.height = size.height;
  return result;
}

}  // namespace

Rectification rectificationOf(const StereoRig& rig) {
  rig.validate();
  if (rig.rectification) return *rig.rectification;
  if (rig.isRectified()) {
    Rectification none;
    none.calibration = {
        rig.left.fx_px, rig.left.cx_px, rig.left.cy_px, rig.baselineM(), rig.right.cx_px - rig.left.cx_px,
        rig.left.width, rig.left.height};
    return none;
  }
  for (const auto& [side, length] :
       {std::pair("width", rig.left.width), std::pair("height", rig.left.height)})
    require(length > 0, side, length, "the images' size, to rectify by");
  Rectification result = bouguet(rig);
  try {
    result.calibration.validate();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(std::string("the rig cannot be rectified: its ") + e.what());
  }
  zoomIn(rig, result);
  return result;
}

}  // namespace pomona
