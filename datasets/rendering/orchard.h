// A fruit wall as a harvesting robot sees it.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "datasets/render.h"

namespace pomona {

struct OrchardOptions {
  std::uint64_t seed = 1;
  /// Band for the depth Z of the fruits' centres, 0.3..10 m, of which most of it is used.
  double nearest_m = 0.6, farthest_m = 0.75;
  int fruits = 0;  ///< 1..200; 0: as many as suit the view, 6 to 14
};

struct Fruit {
  int surface = 0;    ///< in Orchard::scene.surfaces
  std::string label;  ///< "apple" (red), "golden apple"
  cv::Vec3d center_m;
  double radius_m = 0;         ///< at right angles to its axis
  double half_height_m = 0;    ///< along it: 0.88 to 0.98 of the radius
  int cluster = 0;             ///< fruits of one cluster touch
  double distance_m = 0;       ///< from the left camera to its centre
  double near_distance_m = 0;  ///< from the left camera to where the ray to the centre enters the fruit
};

struct Orchard {
  SceneDescription scene;
  std::vector<Fruit> fruits;
};

/// A tree with bent leaves, branches and fruit, leaves before many of them and some in touching pairs; behind
/// it a second row, meadow, hedge and sky. `cameras`: an empty scene (sceneFor()); where it has doffs, the
/// background stays near enough for disparities above 0. Sets num_disparities to what the scene needs. Throws
/// std::invalid_argument naming the option for values that are not allowed.
Orchard orchard(const SceneDescription& cameras, const OrchardOptions& options = {});

}  // namespace pomona
