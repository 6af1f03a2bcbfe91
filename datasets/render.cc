#include "datasets/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "datasets/hash.h"
#include "datasets/rendering/daylight.h"
#include "datasets/rendering/paint.h"
#include "datasets/rendering/picture_rays.h"
#include "datasets/rendering/ray_grid.h"
#include "datasets/rendering/solid.h"

namespace pomona {
namespace {

using cv::Vec3d;

constexpr double kFinestCell_m = 1e-6;

std::vector<Solid> solidsOf(const SceneDescription& scene) {
  std::vector<Solid> solids;
  solids.reserve(scene.surfaces.size());
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    solids.emplace_back(scene.surfaces[i], hash(scene.seed * 0x2545f4914f6cdd1du + i));
  return solids;
}

PictureRays raysOf(const SceneDescription& scene, View view, int threads) {
  const bool right = view == View::kRight;
  return {cv::Size(scene.width, scene.height), scene.focal_px,
          principalOf(scene) + cv::Vec2d(right ? scene.doffs_px : 0, 0),
          right ? scene.right_camera : scene.left_camera, threads};
}

// One of the two cameras: where its pixels look, and what they may see.
struct Eye {
  PictureRays rays;
  RayGrid grid;

  Eye(const SceneDescription& scene, std::span<const Solid> solids, View view, int threads)
      : rays(raysOf(scene, view, threads)),
        grid(solids, {view == View::kRight ? scene.baseline_m : 0, 0, 0}, cv::Matx33d::eye(), rays.range(),
             {scene.width / kCell_px + 1, scene.height / kCell_px + 1}, RayGrid::Beyond::kNothing) {}

  static constexpr int kCell_px = 5;
};

class Renderer {
 public:
  Renderer(const SceneDescription& scene, int threads)
      : scene_(scene),
        threads_(threads),
        solids_(solidsOf(scene)),
        left_(scene, solids_, View::kLeft, threads),
        right_(scene, solids_, View::kRight, threads) {
    if (scene.sun) daylight_.emplace(solids_);
  }

  RenderedView view(View which, const CameraEffects& effects) const {
    const cv::Size size(scene_.width, scene_.height);
    cv::Mat light(size, CV_64FC3);
    RenderedView view{{}, cv::Mat(size, CV_32FC1), cv::Mat(size, CV_8UC1), cv::Mat(size, CV_32SC1)};
    const Eye& eye = which == View::kRight ? right_ : left_;
    parallelStrips(threads_, scene_.height, 4, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < scene_.width; ++x) {
          light.at<Vec3d>(y, x) = meanColor(eye, x, y);
          storeGeometry(which, view, y, x);
        }
    });
    view.image = develop(light, effects, which, scene_.channels, scene_.bits, threads_);
    return view;
  }

 private:
  Vec3d colorAlong(const Eye& eye, const Vec3d& along) const {
    const Hit hit = eye.grid.firstHit(along);
    if (!hit.solid) return {0, 0, 0};
    const Vec3d point = eye.grid.origin() + along * hit.depth;
    const double light = daylight_ ? daylight_->at(*hit.solid, point, along) : studioLight(*hit.solid, point);
    return paintAt(*hit.solid, point, hit.depth / scene_.focal_px) * light;
  }

  Vec3d meanColor(const Eye& eye, int x, int y) const {
    constexpr int kSide = 4;
    Vec3d sum(0, 0, 0);
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        sum += colorAlong(eye, eye.rays.taken(x, y, (i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5));
    return sum * (1.0 / (kSide * kSide));
  }

  void storeGeometry(View which, RenderedView& view, int y, int x) const {
    constexpr std::uint8_t kNothing = 0, kOccluded = 128, kVisible = 255;
    const bool right = which == View::kRight;
    const Eye &here = right ? right_ : left_, &there = right ? left_ : right_;
    const Hit hit = here.grid.firstHit(here.rays.ideal(x, y));
    if (!hit.solid) {
      view.disparity.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
      view.mask.at<std::uint8_t>(y, x) = kNothing;
      view.surface.at<int>(y, x) = -1;
      return;
    }
    const double disparity = scene_.focal_px * scene_.baseline_m / hit.depth - scene_.doffs_px;
    const double other_x = right ? x + disparity : x - disparity;
    const bool inside = other_x >= -0.5 && other_x < scene_.width - 0.5;
    const bool visible =
        inside && there.grid.firstHit(there.rays.ideal(other_x, y)).depth >= hit.depth * (1 - 1e-9);
    view.disparity.at<float>(y, x) = static_cast<float>(disparity);
    view.mask.at<std::uint8_t>(y, x) = visible ? kVisible : kOccluded;
    view.surface.at<int>(y, x) = static_cast<int>(hit.solid - solids_.data());
  }

  const SceneDescription& scene_;
  int threads_;
  std::vector<Solid> solids_;
  Eye left_, right_;
  std::optional<Daylight> daylight_;
};

void require(bool good, const std::string& message) {
  if (!good) throw std::invalid_argument("scene: " + message);
}

void validate(const Surface& s) {
  const double squares = s.center.dot(s.center) + s.u.dot(s.u) + s.v.dot(s.v) + s.radius_m * s.radius_m +
                         s.bend_u_m * s.bend_u_m + s.bend_v_m * s.bend_v_m;
  require(std::isfinite(squares), "a surface has a coordinate that is not finite");
  const Vec3d normal = s.u.cross(s.v);
  const bool round = s.shape == Shape::kSphere || s.shape == Shape::kSpheroid || s.shape == Shape::kBranch;
  const bool has_axis = s.shape == Shape::kSphere || s.v.dot(s.v) > 0;
  require(
      round ? s.radius_m > 0 && has_axis : normal.dot(normal) > 0,
      "a surface without extent: a sphere, a spheroid and a branch need a radius_m > 0, the latter two an "
      "axis v, other shapes u and v that are not parallel");
  constexpr double kRightAngle = 1e-6;
  require(s.shape != Shape::kLeaf ||
              std::abs(s.u.dot(s.v)) <= kRightAngle * std::sqrt(s.u.dot(s.u) * s.v.dot(s.v)),
          "a leaf's u and v must be at right angles");
  require(s.taper >= -1 && s.taper <= 1, "taper is " + std::to_string(s.taper) + "; allowed: -1 to 1");
  require(s.paint.cell_m >= kFinestCell_m, "paint.cell_m must be at least 1e-6 m");
  require(
      s.paint.pattern != Pattern::kPicture ||
          (s.shape == Shape::kParallelogram && !s.paint.picture.empty() && s.paint.picture.type() == CV_8UC3),
      "paint.picture must be of 3 channels of 8 bits, on a parallelogram");
}

void validate(const SceneDescription& scene) {
  constexpr int kLargestSide = 1 << 15;
  const auto side = [&](const char* name, int value) {
    require(value >= 1 && value <= kLargestSide, std::string(name) + " is " + std::to_string(value) +
                                                     "; allowed: 1 to " + std::to_string(kLargestSide));
  };
  side("width", scene.width);
  side("height", scene.height);
  require(scene.channels == 1 || scene.channels == 3,
          "channels is " + std::to_string(scene.channels) + "; allowed: 1 or 3");
  require(scene.bits == 8 || scene.bits == 16,
          "bits is " + std::to_string(scene.bits) + "; allowed: 8 or 16");
  for (const Surface& surface : scene.surfaces) validate(surface);
}

StereoCalibration calibrationOf(const SceneDescription& scene) {
  StereoCalibration calibration;
  calibration.focal_px = scene.focal_px;
  calibration.cx_px = principalOf(scene)[0];
  calibration.cy_px = principalOf(scene)[1];
  calibration.baseline_m = scene.baseline_m;
  calibration.doffs_px = scene.doffs_px;
  calibration.width = scene.width;
  calibration.height = scene.height;
  calibration.num_disparities = scene.num_disparities;
  calibration.validate();
  return calibration;
}

}  // namespace

cv::Vec2d principalOf(const SceneDescription& scene) {
  return scene.principal_px.value_or(cv::Vec2d((scene.width - 1) / 2.0, (scene.height - 1) / 2.0));
}

RenderedPair render(const SceneDescription& scene, const CameraEffects& effects, int threads) {
  validate(scene);
  effects.validate();
  const StereoCalibration calibration = calibrationOf(scene);
  const Renderer renderer(scene, threads > 0 ? threads : availableThreads());
  return {renderer.view(View::kLeft, effects), renderer.view(View::kRight, effects), calibration};
}

Outline outlineOf(const SceneDescription& scene, int surface) {
  const Solid solid(scene.surfaces.at(surface), 0);
  const Bounds bounds = solid.bounds();
  const cv::Vec2d principal = principalOf(scene);
  const auto range = [&](int axis) {
    const auto at = [&](double p, double z) { return p / z * scene.focal_px + principal[axis]; };
    const double low = bounds.low[axis], high = bounds.high[axis];
    const double near = bounds.low[2], far = bounds.high[2];
    return cv::Range(static_cast<int>(std::floor(std::min(at(low, near), at(low, far)))),
                     static_cast<int>(std::ceil(std::max(at(high, near), at(high, far)))) + 1);
  };
  Outline outline;
  if (!(bounds.low[2] > 0)) return outline;
  const cv::Range columns = range(0), rows = range(1);
  for (int y = rows.start; y < rows.end; ++y)
    for (int x = columns.start; x < columns.end; ++x) {
      const Vec3d along((x - principal[0]) / scene.focal_px, (y - principal[1]) / scene.focal_px, 1);
      if (solid.depthAlong({0, 0, 0}, along) == kNowhere) continue;
      ++outline.pixels;
      outline.box_px |= cv::Rect(x, y, 1, 1);
    }
  return outline;
}

}  // namespace pomona
