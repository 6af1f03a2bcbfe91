// Light on surfaces.
#pragma once

#include <optional>
#include <span>

#include "datasets/rendering/ray_grid.h"

namespace pomona {

/// The sun above and behind the cameras' left shoulder, and the sky.
class Daylight {
 public:
  explicit Daylight(std::span<const Solid> solids);

  /// Factor on the paint at `point` of `solid`, seen along `direction`. Lambert's law; leaves let light
  /// through; sun where no surface but a plane is in its way.
  double at(const Solid& solid, const cv::Vec3d& point, const cv::Vec3d& direction) const;

 private:
  RayGrid sun_;
};

/// Without a sun: shades spheres, for their roundness.
double studioLight(const Solid& solid, const cv::Vec3d& point);

}  // namespace pomona
