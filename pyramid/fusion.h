// Fusion of two dense disparity maps of equal size, band by band.
#pragma once

#include "core/image.h"
#include "pyramid/laplacian.h"

namespace pomona {

/// What the functions below keep from one call to the next.
struct FusionScratch {
  LaplacianPyramid a, b;
  GaussianPyramid weight;
};

/// Averages the Laplacian pyramids of `a` and `b` (weights 1/2 and 1/2 on each of up to `levels` levels, see
/// GaussianPyramid::build) and collapses the result into `out`. Building and collapsing are linear and the
/// weights are constant, so this equals (a + b) / 2 up to float rounding, for any number of levels: the
/// published method, kept for comparison with it. `out` may be `a` or `b`.
void fuseEqual(ImageView<const float> a, ImageView<const float> b, int levels, ImageView<float> out,
               FusionScratch& scratch, const PyramidKernels& kernels, int threads);

/// Multiresolution spline (P. J. Burt and E. H. Adelson, "A multiresolution spline with application to image
/// mosaics", ACM Trans. Graphics 2(4), 1983): on each level, G a + (1 - G) b, with G from the Gaussian
/// pyramid of `weight_a`, whose values lie in [0, 1]. The seam between the maps is as wide as the features of
/// each band. Both maps must be dense even where their weight is 0. `out` may be any of the inputs.
void fuseWeighted(ImageView<const float> a, ImageView<const float> b, ImageView<const float> weight_a,
                  int levels, ImageView<float> out, FusionScratch& scratch, const PyramidKernels& kernels,
                  int threads);

}  // namespace pomona
