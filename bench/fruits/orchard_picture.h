// Rendered orchards as a harvesting robot's camera takes them, and the fruits that are to be measured in
// them.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "datasets/render.h"

namespace pomona {

/// Depths of the fruits' centres.
struct Band {
  double nearest_m, farthest_m;
};
/// The robot's working range.
inline constexpr Band kBands[] = {{0.6, 0.75}, {1, 1.2}, {1.6, 1.9}};

/// What the pictures suffer: blur of 0.5 px, shot noise of 2 units at white, read noise of 1, and a right
/// view that is 3 % brighter.
CameraEffects usualEffects(std::uint64_t seed);

struct PicturedFruit {
  int label = 0;  ///< in OrchardPicture::labels
  double visible_share = 0;
  cv::Rect outline_px;         ///< of all of it, what is hidden included
  double near_distance_m = 0;  ///< from the left camera to where the ray to its centre enters it
  double center_distance_m = 0;
};

struct OrchardPicture {
  RenderedPair pair;
  cv::Mat labels;                     ///< CV_16U: which fruit the left view shows, 0 none
  std::vector<PicturedFruit> fruits;  ///< those of which at least kLeastVisible is to be seen
};
inline constexpr double kLeastVisible = 0.3;

/// `cameras`: an empty scene (sceneFor()).
OrchardPicture takePicture(const SceneDescription& cameras, const Band& band, std::uint64_t seed,
                           const CameraEffects& effects);

}  // namespace pomona
