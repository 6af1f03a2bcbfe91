// OpenCV's cv::FileStorage files, under the names that its stereo_calib sample made common.
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "datasets/rig_formats.h"

namespace pomona {
namespace {

constexpr int kLongestSide = 32'000;

void setMatrix(CameraModel& camera, const YamlFields& fields, const std::string& key) {
  const cv::Matx33d k = fields.matrix<3, 3>(key);
  const bool upright = k(0, 0) > 0 && k(1, 1) > 0 && k(0, 1) == 0 && k(1, 0) == 0 && k(2, 0) == 0 &&
                       k(2, 1) == 0 && k(2, 2) == 1;
  if (!upright) fields.fail(key, "[fx 0 cx; 0 fy cy; 0 0 1] with fx, fy > 0");
  camera.fx_px = k(0, 0);
  camera.fy_px = k(1, 1);
  camera.cx_px = k(0, 2);
  camera.cy_px = k(1, 2);
}

DistortionModel modelOf(const YamlFields& fields) {
  if (!fields.has("distortion_model")) return DistortionModel::kPolynomial;
  const std::string name = fields.text("distortion_model");
  if (name == "polynomial") return DistortionModel::kPolynomial;
  if (name == "fisheye") return DistortionModel::kFisheye;
  fields.fail("distortion_model", "polynomial or fisheye");
}

// Empty if the file has neither; one without the other is a mistake.
cv::Size readSize(const YamlFields& fields, const char* width, const char* height) {
  if (!fields.has(width) && !fields.has(height)) return {};
  return {fields.integer(width, 1, kLongestSide), fields.integer(height, 1, kLongestSide)};
}

// Of either file, or of both alike.
cv::Size imageSize(const YamlFields& intrinsics, const YamlFields& extrinsics) {
  const cv::Size first = readSize(intrinsics, "image_width", "image_height");
  const cv::Size second = readSize(extrinsics, "image_width", "image_height");
  if (first.empty() || second.empty()) return first.empty() ? second : first;
  if (first.width != second.width)
    extrinsics.fail("image_width", "that of the intrinsics, " + std::to_string(first.width));
  if (first.height != second.height)
    extrinsics.fail("image_height", "that of the intrinsics, " + std::to_string(first.height));
  return first;
}

Rectification readRectification(const YamlFields& fields, double unit_m, cv::Size size) {
  const RectifiedView left = rectifiedView(fields, "P1"), right = rectifiedView(fields, "P2");
  Rectification result{fields.matrix<3, 3>("R1"), fields.matrix<3, 3>("R2"),
                       calibrationOf(left, right, unit_m, size)};
  if (fields.has("num_disparities"))
    result.calibration.num_disparities = fields.integer("num_disparities", 0, 1 << 20);
  return result;
}

}  // namespace

void setDistortion(CameraModel& camera, const YamlFields& fields, const std::string& key) {
  const std::vector<double> k = fields.numbers(key);
  const bool fisheye = camera.distortion_model == DistortionModel::kFisheye;
  const std::size_t used = fisheye ? 4 : camera.distortion.size();
  const bool right_count = fisheye ? k.size() == 4
                                   : k.empty() || k.size() == 4 || k.size() == 5 || k.size() == 8 ||
                                         k.size() == 12 || k.size() == 14;
  if (!right_count) fields.fail(key, fisheye ? "4 coefficients" : "0, 4, 5 or 8 coefficients");
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (i < used)
      camera.distortion[i] = k[i];
    else if (k[i] != 0)
      fields.fail(key, "8 coefficients; thin prisms and tilted sensors are not supported");
  }
}

RectifiedView rectifiedView(const cv::Matx34d& p) {
  const bool upright = p(0, 0) > 0 && p(1, 1) > 0 && p(0, 1) == 0 && p(1, 0) == 0 && p(2, 0) == 0 &&
                       p(2, 1) == 0 && std::abs(p(2, 2) - 1) < 1e-9;
  if (!upright) throw std::invalid_argument("[f 0 cx t; 0 f cy t; 0 0 1 t] with f > 0");
  if (std::abs(p(0, 0) - p(1, 1)) > 1e-6 * p(0, 0))
    throw std::invalid_argument("equal fx and fy, as in a rectified view (here " + numberText(p(0, 0)) +
                                " and " + numberText(p(1, 1)) + ")");
  return {p(0, 0), p(0, 2), p(1, 2), p(0, 3)};
}

RectifiedView rectifiedView(const YamlFields& fields, const std::string& key) {
  try {
    return rectifiedView(fields.matrix<3, 4>(key));
  } catch (const std::invalid_argument& e) {
    fields.fail(key, e.what());
  }
}

StereoCalibration calibrationOf(const RectifiedView& left, const RectifiedView& right, double unit_m,
                                cv::Size size) {
  const auto requireEqual = [](const char* field, double in_left, double in_right, double tolerance) {
    if (std::abs(in_left - in_right) > tolerance)
      throw std::invalid_argument("the projection matrices have " + std::string(field) + " " +
                                  numberText(in_left) + " (left) and " + numberText(in_right) +
                                  " (right); allowed: the same, for a rectified pair");
  };
  requireEqual("f", left.focal_px, right.focal_px, 1e-6 * left.focal_px);
  requireEqual("cy", left.cy_px, right.cy_px, 1e-3);
  const double fb = left.offset - right.offset;
  if (fb == 0)
    throw std::invalid_argument(
        "the projection matrices have no baseline (element 4 is the same in both): the cameras "
        "were not calibrated as a pair");
  if (fb < 0)
    throw std::invalid_argument(
        "the projection matrices put the right camera on the left (element 4, -f * "
        "baseline, must be negative in the right one): left and right are exchanged");
  StereoCalibration c;
  c.focal_px = left.focal_px;
  c.cx_px = left.cx_px;
  c.cy_px = left.cy_px;
  c.doffs_px = right.cx_px - left.cx_px;
  c.baseline_m = fb / left.focal_px * unit_m;
  c.width = size.width;
  c.height = size.height;
  return c;
}

StereoRig rigFromOpenCv(const YamlFields& intrinsics, const YamlFields& extrinsics, double unit_m) {
  StereoRig rig;
  rig.left.distortion_model = rig.right.distortion_model = modelOf(intrinsics);
  setMatrix(rig.left, intrinsics, "M1");
  setDistortion(rig.left, intrinsics, "D1");
  setMatrix(rig.right, intrinsics, "M2");
  setDistortion(rig.right, intrinsics, "D2");
  const cv::Size size = imageSize(intrinsics, extrinsics);
  rig.left.width = rig.right.width = size.width;
  rig.left.height = rig.right.height = size.height;
  rig.right_from_left_rotation = extrinsics.matrix<3, 3>("R");
  const cv::Matx31d t = extrinsics.matrix<3, 1>("T");
  rig.right_from_left_m = cv::Vec3d(t(0), t(1), t(2)) * unit_m;
  const bool stated =
      extrinsics.has("R1") || extrinsics.has("P1") || extrinsics.has("R2") || extrinsics.has("P2");
  if (stated) {
    const cv::Size rectified = readSize(extrinsics, "rectified_width", "rectified_height");
    rig.rectification = readRectification(extrinsics, unit_m, rectified.empty() ? size : rectified);
  }
  return rig;
}

}  // namespace pomona
