// Removal of small regions of a disparity map.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

/// Finds the 4-connected components of known (not NaN) pixels in which neighbours differ by at most
/// `max_step_px`, and makes every pixel of components of fewer than `min_size_px` pixels unknown: disparity
/// NaN, state PixelState::kSpeckle. Linear in the number of pixels, at most 2^31 of them.
void removeSpeckles(ImageView<float> disparity, ImageView<std::uint8_t> state, int min_size_px,
                    float max_step_px, Arena& scratch, const FilterKernels& kernels, int threads);

}  // namespace pomona
