#include "datasets/rendering/named_rigs.h"

#include <stdexcept>

#include "datasets/rendering/require_range.h"

namespace pomona {
namespace {

using Coefficients = std::array<double, 8>;

// Parallel cameras: what makes them a rig to be rectified is their lenses alone.
StereoRig parallelRig(const StereoCalibration& c, const Coefficients& left, const Coefficients& right) {
  StereoRig rig;
  rig.left = {c.width, c.height, c.focal_px, c.focal_px, c.cx_px, c.cy_px, DistortionModel::kPolynomial,
              left};
  rig.right = rig.left;
  rig.right.cx_px += c.doffs_px;
  rig.right.distortion = right;
  rig.right_from_left_m = {-c.baseline_m, 0, 0};
  rig.rectification = Rectification{cv::Matx33d::eye(), cv::Matx33d::eye(), c};
  return rig;
}

StereoRig robot(double baseline_m) {
  StereoCalibration c;
  c.focal_px = 1056.6;
  c.cx_px = 639.5;
  c.cy_px = 359.5;
  c.baseline_m = baseline_m;
  c.width = 1280;
  c.height = 720;
  return parallelRig(c, {-0.172, 0.031, 0.0006, -0.0004, -0.004}, {-0.168, 0.026, -0.0003, 0.0005, 0.003});
}

StereoRig middlebury() {
  StereoCalibration c;
  c.focal_px = 1990;
  c.cx_px = 625;
  c.cy_px = 496.5;
  c.baseline_m = 0.193;
  c.doffs_px = 62;
  c.width = 1482;
  c.height = 994;
  return parallelRig(c, {}, {});
}

struct NamedRig {
  const char* name;
  StereoRig (*make)();
};
constexpr NamedRig kRigs[] = {{"middlebury", middlebury},
                              {"seed-003", [] { return robot(0.120); }},
                              {"seed-003-b60", [] { return robot(0.060); }}};

// What becomes of a camera's figures when its image is `scale` times as wide, and as high as is wanted.
void resize(double scale, int old_height, int height, double& focal_px, double& cx_px, double& cy_px) {
  focal_px *= scale;
  cx_px = (cx_px + 0.5) * scale - 0.5;
  cy_px = (cy_px - (old_height - 1) / 2.0) * scale + (height - 1) / 2.0;
}

}  // namespace

std::vector<std::string> rigNames() {
  std::vector<std::string> names;
  for (const NamedRig& rig : kRigs) names.emplace_back(rig.name);
  return names;
}

StereoRig namedRig(std::string_view name) {
  std::string allowed;
  for (const NamedRig& rig : kRigs) {
    if (name == rig.name) return rig.make();
    allowed += (allowed.empty() ? "" : ", ") + std::string(rig.name);
  }
  throw std::invalid_argument("rig is '" + std::string(name) + "'; allowed: " + allowed);
}

StereoRig resized(const StereoRig& rig, int width, int height) {
  constexpr int kSmallestSide = 16, kLargestSide = 8192;
  requireRange("width", width, kSmallestSide, kLargestSide);
  requireRange("height", height, kSmallestSide, kLargestSide);
  StereoRig result = rig;
  result.rectification = rectificationOf(rig);
  StereoCalibration& c = result.rectification->calibration;
  const double scale = 1.0 * width / c.width;
  resize(scale, c.height, height, c.focal_px, c.cx_px, c.cy_px);
  c.doffs_px *= scale;
  for (CameraModel* camera : {&result.left, &result.right}) {
    camera->fy_px *= scale;
    resize(scale, c.height, height, camera->fx_px, camera->cx_px, camera->cy_px);
    camera->width = width;
    camera->height = height;
  }
  c.width = width;
  c.height = height;
  return result;
}

SceneDescription sceneFor(const StereoRig& rig) {
  const StereoCalibration c = rectificationOf(rig).calibration;
  SceneDescription scene;
  scene.width = c.width;
  scene.height = c.height;
  scene.focal_px = c.focal_px;
  scene.baseline_m = c.baseline_m;
  scene.principal_px = cv::Vec2d(c.cx_px, c.cy_px);
  scene.doffs_px = c.doffs_px;
  return scene;
}

void takeThroughLenses(const StereoRig& rig, SceneDescription& scene) {
  const Rectification rectification = rectificationOf(rig);
  scene.left_camera = PictureCamera{rig.left, rectification.left_rotation};
  scene.right_camera = PictureCamera{rig.right, rectification.right_rotation};
}

void shiftRightView(double rows_px, SceneDescription& scene) {
  requireRange("right_shift_px", rows_px, -scene.height, scene.height);
  if (!scene.right_camera) {
    const cv::Vec2d principal = principalOf(scene);
    scene.right_camera = PictureCamera{CameraModel{scene.width, scene.height, scene.focal_px, scene.focal_px,
                                                   principal[0] + scene.doffs_px, principal[1]}};
  }
  scene.right_camera->model.cy_px -= rows_px;
}

}  // namespace pomona
