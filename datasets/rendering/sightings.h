// What a rendered view shows of some surfaces.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "datasets/render.h"

namespace pomona {

/// In the left view.
struct Sighting {
  int visible_px = 0;        ///< pixels whose centres show the surface
  double visible_share = 0;  ///< of the pixels that its outline covers, parts outside of the image included
  double seen_by_both = 0;   ///< share of visible_px that the right view sees, too
  cv::Rect box_px;           ///< of its whole outline
  double nearest_z_m = 0;    ///< smallest depth Z of the visible pixels; NaN if there is none
};

/// One for each of `surfaces`, numbers in scene.surfaces.
std::vector<Sighting> sightings(const SceneDescription& scene, const RenderedPair& pair,
                                const std::vector<int>& surfaces);

/// CV_16U: where the left view shows surfaces[i], 1 + i; else 0.
cv::Mat labelsOf(const SceneDescription& scene, const RenderedPair& pair, const std::vector<int>& surfaces);

}  // namespace pomona
