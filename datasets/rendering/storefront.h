// Shops along a street: flat walls at known distances and angles, with signs to be found again.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "datasets/render.h"

namespace pomona {

struct StorefrontOptions {
  std::uint64_t seed = 1;
  int walls = 3;  ///< 1..8, side by side
  /// Bands for the depth Z of the walls' middles, 0.5..20 m, and for their yaw, -60..60 degrees: 0 faces the
  /// cameras, and a wall of positive yaw is farther at its right end.
  double nearest_m = 2, farthest_m = 5;
  double least_yaw_deg = -45, greatest_yaw_deg = 45;
};

/// Places on it are center + a u + b v, |a|, |b| <= 1.
struct Sign {
  int surface = 0;  ///< in Storefront::scene.surfaces
  int wall = 0;
  std::string text;
  cv::Vec3d center_m, u_m, v_m;
  double yaw_deg = 0;
};

struct Storefront {
  SceneDescription scene;
  std::vector<Sign> signs;
};

/// Walls of brick with windows, doors and two or three signs each; pavement before them, a house front
/// behind. `cameras`: an empty scene (sceneFor()). Sets num_disparities to what the scene needs. Throws
/// std::invalid_argument naming the option for values that are not allowed.
Storefront storefront(const SceneDescription& cameras, const StorefrontOptions& options = {});

}  // namespace pomona
