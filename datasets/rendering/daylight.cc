#include "datasets/rendering/daylight.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

using cv::Vec3d;

const Vec3d kTowardsLight(-0.48, -0.6, -0.64);
const Vec3d kSunPlace = Vec3d(0, 0, 2) + kTowardsLight * 60;  // far enough for shadows without perspective

// Rows: at right angles to the light, and along it.
cv::Matx33d axesAlongLight() {
  const Vec3d z = -kTowardsLight, x = Vec3d(0.8, 0, -0.6), y = z.cross(x);
  return {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

}  // namespace

Daylight::Daylight(std::span<const Solid> solids)
    : sun_(solids, kSunPlace, axesAlongLight(), busyRange(solids, kSunPlace, axesAlongLight()), {512, 512},
           RayGrid::Beyond::kEdgeCells) {}

double Daylight::at(const Solid& solid, const Vec3d& point, const Vec3d& direction) const {
  constexpr double kSky = 0.42, kFromAbove = 0.14, kSun = 0.72, kThroughLeaf = 0.55;
  constexpr double kOffSurface_m = 0.0005;
  Vec3d normal = solid.normalAt(point);
  if (normal.dot(direction) > 0) normal = -normal;
  const double sky = kSky - kFromAbove * normal[1];
  double sun = normal.dot(kTowardsLight);
  if (sun < 0) sun = solid.shape == Shape::kLeaf ? -kThroughLeaf * sun : 0;
  if (sun == 0) return sky;
  const Vec3d ray = point - sun_.origin();
  const bool shadow = sun_.isBlocked(ray, 1 - kOffSurface_m / std::sqrt(ray.dot(ray)));
  return shadow ? sky : sky + kSun * sun;
}

double studioLight(const Solid& solid, const Vec3d& point) {
  if (solid.shape != Shape::kSphere) return 1;
  return 0.45 + 0.55 * std::max(0.0, (point - solid.center).dot(kTowardsLight) / solid.radiusM());
}

}  // namespace pomona
