// Where blobs are, and how large: maxima of the determinant of the Hessian over place and scale.
#pragma once

#include <vector>

#include "plugins/common/surf/integral_image.h"
#include "plugins/common/surf/surf_options.h"

namespace pomona {

struct InterestPoint {
  float x, y;      ///< px; whole numbers are centres of pixels
  float size_px;   ///< side of the box filter that fits best, between two of those that were tried
  float response;  ///< determinant of the Hessian there
  int octave;      ///< from 0
  bool is_dark;    ///< darker than its surroundings: the sign of the Laplacian
};

/// Maxima among their 26 neighbours, moved to the top of the quadratic through these (section 3.3 of the
/// paper); dropped where that lies further than a step away, as the quadratic then says nothing. (To drop
/// beyond half a step costs one in thirty of the points that other views show, too.) A blob that two
/// successive octaves find is kept once. In order of octave, row, layer and column, whatever the number of
/// threads.
std::vector<InterestPoint> findInterestPoints(const IntegralImage& image, const SurfOptions& options);

}  // namespace pomona
