// A room as a small robot sees it: a floor almost without texture, and things that stand on it.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "datasets/render.h"

namespace pomona {

struct IndoorOptions {
  std::uint64_t seed = 1;
  int obstacles = 5;  ///< 0..20 boxes
  /// Band for the depth Z of the boxes' near sides, 0.5..20 m. The wall stands 1.5 m behind it.
  double nearest_m = 1.8, farthest_m = 4;
  double camera_height_m = 0.5;  ///< above the floor, 0.1..3; the cameras look level
  /// By how much the paint of floor and wall varies, 8-bit units, 1..200: most of it within a third of that
  /// to either side of the mean. Boxes vary three times as much.
  double contrast = 14;
};

struct Obstacle {
  int first_surface = 0;   ///< of its five, in Indoor::scene.surfaces; the first is its near side
  cv::Vec3d near_point_m;  ///< the middle of the near side
  double height_m = 0;
};

struct Indoor {
  SceneDescription scene;
  std::vector<Obstacle> obstacles;
};

/// Boxes side by side on a floor before a wall with two pictures. `cameras`: an empty scene (sceneFor()).
/// Sets num_disparities to what the scene needs. Throws std::invalid_argument naming the option for values
/// that are not allowed.
Indoor indoor(const SceneDescription& cameras, const IndoorOptions& options = {});

}  // namespace pomona
