// Removal of small regions of a disparity map.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

struct SpeckleScratch {
  struct RowRuns {
    int first, last;  ///< runs[first] up to, not including, runs[last]
  };
  Buffer<SpeckleRun, Pages::kSmall> runs;  // room for a run per pixel
  Buffer<RowRuns> rows;
  Image<std::uint64_t> breaks;
};

/// Finds the 4-connected components of known (not NaN) pixels in which neighbours differ by at most
/// `max_step_px`, and makes every pixel of components of fewer than `min_size_px` pixels unknown: disparity
/// NaN, state PixelState::kSpeckle. Linear in the number of pixels, at most 2^31 of them.
void removeSpeckles(ImageView<float> disparity, ImageView<std::uint8_t> state, int min_size_px,
                    float max_step_px, SpeckleScratch& scratch, const FilterKernels& kernels, int threads);

}  // namespace pomona
