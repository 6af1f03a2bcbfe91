// Colour-weighted median: moves the jumps of a dense disparity map to the edges of the image.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

/// The weighted median (Ma et al. 2013, "Constant time weighted median filtering for stereo matching and
/// beyond") at pixels near a jump; elsewhere out = in.
///
/// A pixel p is near a jump if one of its 8 neighbours differs from it by more than 1 px. It takes the
/// smallest disparity v of its window for which
///
///   sum of w(p, q) over q with in(q) <= v  >=  half the sum of w(p, q) over all q,
///   w(p, q) = exp(-|I(p) - I(q)| / 8 - |p - q| / 9),
///
/// with |I(p) - I(q)| the mean over the channels, in 8-bit units, and |p - q| in pixels. The window is a
/// checkerboard: of the 11 x 11 pixels around p, clipped to the image, those with an even |x| + |y| from p;
/// for the same time, it serves better than a full 7 x 7. Unknown pixels (NaN) are neither read nor written.
/// Weights are exact to a relative 1e-5, unless they are below 2^-100.
///
/// `in`, `guide` and `out` have the same size; `out` may be `in`. Disparities are finite or NaN. Throws
/// std::invalid_argument if the guide has other than 1 or 3 channels.
void weightedMedian(ImageView<const float> in, GuideView guide, ImageView<float> out, Arena& scratch,
                    const FilterKernels& kernels, int threads);

}  // namespace pomona
