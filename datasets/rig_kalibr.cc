// Kalibr's camchain.yaml.
#include <algorithm>
#include <stdexcept>

#include "datasets/rig_formats.h"

namespace pomona {
namespace {

constexpr int kLongestSide = 32'000;

CameraModel readCamera(const YamlFields& fields) {
  CameraModel camera;
  if (fields.text("camera_model") != "pinhole")
    fields.fail("camera_model", "pinhole (with distortion_model radtan, equidistant or none)");
  const cv::Matx<double, 1, 4> k = fields.matrix<1, 4>("intrinsics");
  if (!(k(0) > 0 && k(1) > 0)) fields.fail("intrinsics", "[fu, fv, pu, pv] with fu, fv > 0");
  camera.fx_px = k(0);
  camera.fy_px = k(1);
  camera.cx_px = k(2);
  camera.cy_px = k(3);
  const std::string model = fields.text("distortion_model");
  if (model == "equidistant")
    camera.distortion_model = DistortionModel::kFisheye;
  else if (model != "radtan" && model != "none")
    fields.fail("distortion_model", "radtan, equidistant or none");
  if (model != "none") {
    const char* key = "distortion_coeffs";
    if (fields.numbers(key).size() != 4) fields.fail(key, "4 coefficients");
    setDistortion(camera, fields, key);
  }
  const cv::Matx<double, 1, 2> size = fields.matrix<1, 2>("resolution");
  for (const double side : size.val)
    if (!(side >= 1 && side <= kLongestSide && side == static_cast<int>(side)))
      fields.fail("resolution", "[width, height], whole numbers from 1 to 32000");
  camera.width = static_cast<int>(size(0));
  camera.height = static_cast<int>(size(1));
  return camera;
}

std::string nameOf(int camera) {
  return "cam" + std::to_string(camera);
}

}  // namespace

StereoRig rigFromKalibr(const YamlFields& chain, const RigFileOptions& options, double unit_m) {
  const int left = std::max(0, options.left_camera);
  const int right = options.right_camera < 0 ? 1 : options.right_camera;
  StereoRig rig;
  rig.left = readCamera(chain.map(nameOf(left)));
  rig.right = readCamera(chain.map(nameOf(right)));

  // From the first to the last of the two along the chain; backwards if the right one comes first.
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d translation;
  for (int i = std::min(left, right) + 1; i <= std::max(left, right); ++i) {
    const cv::Matx44d step = chain.map(nameOf(i)).matrix<4, 4>("T_cn_cnm1");
    if (step(3, 0) != 0 || step(3, 1) != 0 || step(3, 2) != 0 || step(3, 3) != 1)
      chain.map(nameOf(i)).fail("T_cn_cnm1", "4 rows of 4, the last 0 0 0 1");
    const cv::Matx33d r = step.get_minor<3, 3>(0, 0);
    translation = r * translation + cv::Vec3d(step(0, 3), step(1, 3), step(2, 3)) * unit_m;
    rotation = r * rotation;
  }
  const bool backwards = left > right;
  rig.right_from_left_rotation = backwards ? rotation.t() : rotation;
  rig.right_from_left_m = backwards ? -(rotation.t() * translation) : translation;
  return rig;
}

}  // namespace pomona
