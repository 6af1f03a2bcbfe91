// A disparity map beside the colours of its guide image, laid out for window kernels.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "filters/kernels.h"
#include "filters/padded_plane.h"

namespace pomona {

/// Disparities are NaN in the border. A colour is one 32-bit word, a channel per byte from the lowest up, the
/// highest byte 0; a gray guide counts as three equal channels.
class GuidedPlane {
 public:
  /// Copies a map and its guide, of the same size, into the current scope of `arena`, and puts a border of
  /// `radius` pixels around them. Throws std::invalid_argument if the guide has other than 1 or 3 channels.
  GuidedPlane(ImageView<const float> disparity, GuideView guide, int radius, Arena& arena, int threads);

  GuidedRow row(int y) const { return {disparity_.row(y), color_.row(y), disparity_.stride()}; }

 private:
  PaddedImage<float> disparity_;
  PaddedImage<std::uint32_t> color_;
};

}  // namespace pomona
