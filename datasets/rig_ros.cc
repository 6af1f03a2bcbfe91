// ROS camera_info: as camera_calibration_parsers write it, in OpenCV's syntax, or as `rostopic echo` prints
// it.
#include "datasets/rig_formats.h"

namespace pomona {
namespace {

constexpr int kLongestSide = 32'000;

struct CameraInfo {
  CameraModel camera;
  cv::Matx33d rotation;
  RectifiedView view;
};

DistortionModel modelOf(const YamlFields& fields) {
  if (!fields.has("distortion_model")) return DistortionModel::kPolynomial;
  const std::string name = fields.text("distortion_model");
  if (name == "plumb_bob" || name == "rational_polynomial") return DistortionModel::kPolynomial;
  if (name == "equidistant") return DistortionModel::kFisheye;
  fields.fail("distortion_model", "plumb_bob, rational_polynomial or equidistant");
}

CameraInfo readCamera(const YamlFields& fields) {
  CameraInfo info;
  CameraModel& camera = info.camera;
  camera.width = fields.integer(fields.oneOf({"image_width", "width"}), 1, kLongestSide);
  camera.height = fields.integer(fields.oneOf({"image_height", "height"}), 1, kLongestSide);
  const std::string matrix = fields.oneOf({"camera_matrix", "K", "k"});
  const cv::Matx33d k = fields.matrix<3, 3>(matrix);
  if (!(k(0, 0) > 0 && k(1, 1) > 0 && k(2, 2) == 1))
    fields.fail(matrix, "[fx 0 cx 0 fy cy 0 0 1] with fx, fy > 0");
  camera.fx_px = k(0, 0);
  camera.fy_px = k(1, 1);
  camera.cx_px = k(0, 2);
  camera.cy_px = k(1, 2);
  camera.distortion_model = modelOf(fields);
  setDistortion(camera, fields, fields.oneOf({"distortion_coefficients", "D", "d"}));
  info.rotation = fields.matrix<3, 3>(fields.oneOf({"rectification_matrix", "R", "r"}));
  info.view = rectifiedView(fields, fields.oneOf({"projection_matrix", "P", "p"}));
  return info;
}

}  // namespace

StereoRig rigFromRos(const YamlFields& left_fields, const YamlFields& right_fields, double unit_m) {
  const CameraInfo left = readCamera(left_fields), right = readCamera(right_fields);
  StereoRig rig;
  rig.left = left.camera;
  rig.right = right.camera;
  const StereoCalibration calibration =
      calibrationOf(left.view, right.view, unit_m, cv::Size(left.camera.width, left.camera.height));
  rig.rectification = Rectification{left.rotation, right.rotation, calibration};
  // Rectified, the right camera is at (baseline, 0, 0): X_right = R_right^T (R_left X_left - (baseline, 0,
  // 0)).
  rig.right_from_left_rotation = right.rotation.t() * left.rotation;
  rig.right_from_left_m = right.rotation.t() * cv::Vec3d(-calibration.baseline_m, 0, 0);
  return rig;
}

}  // namespace pomona
