// Changing the size of images and of disparity maps.
//
// Pixels are unit squares: pixel i of n covers [i / n, (i + 1) / n) of the side, at every scale. Nothing
// shifts by half a pixel between scales, and the true ratio of the sides is used on each axis.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// ceil(length / factor), at least 1. `length`, `factor` >= 1.
int scaledLength(int length, int factor);

/// The mean of `in` over the exact, possibly fractional, area that each output pixel covers, rounded to
/// nearest (halves up). Computed in integers: the result is the correctly rounded true mean for any pair of
/// sizes. The row of `out` holds its pixels' channels interleaved as in `in`, so that its width is a multiple
/// of their number. Sides: 1..65535 pixels.
void areaDownscale(GuideView in, ImageView<std::uint8_t> out, Arena& scratch, const PyramidKernels& kernels,
                   int threads);
/// The same for one 16-bit channel.
void areaDownscale(ImageView<const std::uint16_t> in, ImageView<std::uint16_t> out, Arena& scratch,
                   const PyramidKernels& kernels, int threads);

/// Cubic convolution with a = -1/2 (R. Keys, "Cubic convolution interpolation for digital image processing",
/// 1981), border replicated, from the size of `in` to the size of `out`; both are at least 1 x 1 and do not
/// overlap. NaN counts as absent: where some of the sixteen taps are absent, the result is the mean of the
/// others under the magnitudes of their weights (negative weights without their partners could extrapolate
/// without bound), and NaN where none with a weight is left. Values are not scaled: see scaleDisparity().
void bicubicUpscale(ImageView<const float> in, ImageView<float> out, Arena& scratch,
                    const PyramidKernels& kernels, int threads);

/// Multiplies by `ratio`, the ratio of the widths, once a disparity map has changed its size. NaN stays NaN.
void scaleDisparity(ImageView<float> disparity, float ratio, int threads);

}  // namespace pomona
