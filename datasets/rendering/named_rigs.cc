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

// The camera that takes a view's picture, to be changed.
CameraModel& cameraOf(SceneDescription& scene, View view) {
  auto& camera = view == View::kRight ? scene.right_camera : scene.left_camera;
  if (!camera) {
    const cv::Vec2d principal =
        scene.principal_px.value_or(cv::Vec2d((scene.width - 1) / 2.0, (scene.height - 1) / 2.0));
    const double cx = principal[0] + (view == View::kRight ? scene.doffs_px : 0);
    camera = CameraModel{scene.width, scene.height, scene.focal_px, scene.focal_px, cx, principal[1]};
  }
  return *camera;
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
  const StereoCalibration old = rectificationOf(rig).calibration;
  StereoCalibration c = old;
  const double scale = 1.0 * width / old.width;
  c.width = width;
  c.height = height;
  c.focal_px = old.focal_px * scale;
  c.cx_px = (old.cx_px + 0.5) * scale - 0.5;
  c.cy_px = (old.cy_px - (old.height - 1) / 2.0) * scale + (height - 1) / 2.0;
  c.doffs_px = old.doffs_px * scale;
  return parallelRig(c, rig.left.distortion, rig.right.distortion);
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
  scene.left_camera = rig.left;
  scene.right_camera = rig.right;
}

void shiftRightView(double rows_px, SceneDescription& scene) {
  cameraOf(scene, View::kRight).cy_px -= rows_px;
}

}  // namespace pomona
