// How much the colour changes from a pixel to its neighbours: what steers penalties and supports.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sgm/kernels.h"

namespace pomona {

/// Largest channel difference, 8-bit units, between (x, y) and one neighbour of the row above or to the left;
/// 0 where that lies outside the image. The other four neighbours see the same steps from their side.
struct ColorSteps {
  Image<std::uint8_t> left, above_left, above, above_right;

  void compute(GuideView image, const SgmKernels& kernels, int threads);
};

}  // namespace pomona
