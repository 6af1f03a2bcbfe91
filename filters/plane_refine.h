// Local plane fit: takes the sub-pixel noise out of a disparity map, and keeps its slants and edges.
#pragma once

#include "core/arena.h"
#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

/// Replaces each disparity by the value, at its place, of a plane through its neighbours.
///
/// A pixel q of the (2 radius + 1)^2 window around p, clipped to the image, is taken if it is known,
/// |in(q) - in(p)| < 1 px, and no channel of the guide differs by 15 or more. With (x, y) = q - p,
/// z = in(q) - in(p), bars for means over the q taken, and Cab = mean(a b) - mean(a) mean(b),
///
///   out(p) = in(p) + z' - a x' - b y',    [Cxx + r, Cxy; Cxy, Cyy + r] [a; b] = [Cxz; Cyz]
///
/// where x', y', z' are the means, and the ridge r = 0.3 px^2 draws ill-determined slopes to 0. Pixels with
/// fewer than 6 q, themselves among them, stay as they are; unknown pixels (NaN) stay unknown.
///
/// `radius`: 2 or 3 pixels. `in`, `guide` and `out` have the same size; `out` may be `in`. Disparities are
/// finite or NaN. Throws std::invalid_argument for another radius, or if the guide has other than 1 or 3
/// channels.
void refinePlanes(ImageView<const float> in, GuideView guide, int radius, ImageView<float> out,
                  Arena& scratch, const FilterKernels& kernels, int threads);

}  // namespace pomona
