#include "datasets/rendering/nearest_surface.h"

#include <algorithm>
#include <cmath>

#include "datasets/rendering/solid.h"

namespace pomona {

int disparitiesFor(const SceneDescription& scene) {
  const cv::Vec2d principal = principalOf(scene);
  double nearest = kFarthest_m;
  for (const Surface& surface : scene.surfaces) {
    const Solid solid(surface, 0);
    if (surface.shape != Shape::kPlane) {
      if (solid.bounds().low[2] > 0) nearest = std::min(nearest, solid.bounds().low[2]);
      continue;
    }
    for (const double x : {0.0, scene.width - 1.0})
      for (const double y : {0.0, scene.height - 1.0}) {
        const cv::Vec3d along((x - principal[0]) / scene.focal_px, (y - principal[1]) / scene.focal_px, 1);
        nearest = std::min(nearest, solid.depthAlong({0, 0, 0}, along));
      }
  }
  const double largest = scene.focal_px * scene.baseline_m / nearest - scene.doffs_px;
  return 16 * std::max(1, static_cast<int>(std::ceil((largest + 1) / 16)));
}

}  // namespace pomona
