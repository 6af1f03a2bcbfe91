// Fusion of two dense disparity maps of equal size, band by band.
#pragma once

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// Averages the Laplacian pyramids of `a` and `b` (weights 1/2 and 1/2 on each of up to `levels` levels, see
/// GaussianPyramid::build) and collapses the result into `out`. Building and collapsing are linear and the
/// weights are constant, so this equals (a + b) / 2 up to float rounding, for any number of levels: the
/// published method, kept for comparison with it. `out` may be `a` or `b`.
void fuseEqual(ImageView<const float> a, ImageView<const float> b, int levels, ImageView<float> out,
               Arena& scratch, const PyramidKernels& kernels, int threads);

}  // namespace pomona
