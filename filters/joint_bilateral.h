// Joint bilateral filter: smooths and completes a disparity map along the edges of a guide image.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

enum class BilateralTarget {
  kEveryPixel,  ///< known pixels are smoothed, holes filled
  kHolesOnly,   ///< known pixels are kept as they are
};

struct BilateralParameters {
  float sigma_space_px = 10.0f;  ///< sigma_s, > 0
  float sigma_range = 30.0f;     ///< sigma_r in 8-bit grey levels, > 0
  BilateralTarget target = BilateralTarget::kEveryPixel;
};

/// The joint (cross) bilateral filter (Petschnigg et al. 2004, Eisemann & Durand 2004; Kopf et al. 2007 for
/// completion), over the whole window, for maps with holes (NaN):
///
///   out(p) = sum_q w(p, q) in(q) / sum_q w(p, q)
///   w(p, q) = exp(-|p - q|^2 / (2 sigma_s^2)) exp(-m(p, q) / (2 sigma_r^2))
///
/// with q over the known pixels within r = ceil(2 sigma_s) of p in x and in y, and m the mean over the
/// channels of the squared guide difference. A hole stays a hole if its weights sum to less than
/// kMinimumBilateralWeight. Weights are exact to a relative 1e-5, unless they are below 2^-100.
///
/// `in`, `guide` and `out` have the same size; `out` may be `in`. Disparities are finite or NaN. Throws
/// std::invalid_argument if a sigma is not positive and finite, or the guide has other than 1 or 3 channels.
void jointBilateral(ImageView<const float> in, GuideView guide, const BilateralParameters& parameters,
                    ImageView<float> out, Arena& scratch, const FilterKernels& kernels, int threads);

/// The filter above, then again on the remaining holes alone, each time from the pixels known by then, until
/// no hole is left or none can be filled. A map without any known pixel stays as it is. Holes deeper than the
/// window cost a pass per window radius, but a pass computes only pixels with a known pixel in or near their
/// window.
void completeByBilateral(ImageView<const float> in, GuideView guide, const BilateralParameters& parameters,
                         ImageView<float> out, Arena& scratch, const FilterKernels& kernels, int threads);

}  // namespace pomona
