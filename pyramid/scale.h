// Changing the size of images and of disparity maps.
//
// Pixels are unit squares: pixel i of n covers [i / n, (i + 1) / n) of the side, at every scale. Nothing
// shifts by half a pixel between scales, and the true ratio of the sides is used on each axis.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// The pixels of the input that one pixel of the output covers, in exact arithmetic: the first one with
/// weight `first_weight`, the last of `count` with `last_weight`, those between with the ratio's denominator.
struct AreaSpan {
  int first, count;
  std::uint32_t first_weight, last_weight;
};

/// The four samples and weights behind each output sample of a cubic convolution; tap k of sample x is at k n
/// + x.
struct CubicTaps {
  Buffer<std::int32_t> index;
  Buffer<float> weight;
};

/// What the functions below keep from one call to the next.
struct ScaleScratch {
  Image<std::uint32_t> column_sums;
  Buffer<AreaSpan> spans;
  CubicTaps columns, rows;
  Image<float> widened;
  Buffer<std::uint8_t> row_has_nan;
};

/// ceil(length / factor), at least 1. `length`, `factor` >= 1.
int scaledLength(int length, int factor);

/// The mean of `in` over the exact, possibly fractional, area that each output pixel covers, rounded to
/// nearest (halves up). Computed in integers: the result is the correctly rounded true mean for any pair of
/// sizes. `out` is resized to out_w * channels x out_h, channels interleaved as in `in`. Sides: 1..65535.
void areaDownscale(GuideView in, Image<std::uint8_t>& out, int out_w, int out_h, ScaleScratch& scratch,
                   const PyramidKernels& kernels, int threads);
/// The same for one 16-bit channel.
void areaDownscale(ImageView<const std::uint16_t> in, Image<std::uint16_t>& out, int out_w, int out_h,
                   ScaleScratch& scratch, const PyramidKernels& kernels, int threads);

/// Cubic convolution with a = -1/2 (R. Keys, "Cubic convolution interpolation for digital image processing",
/// 1981), border replicated, from the size of `in` to the size of `out`; both are at least 1 x 1 and do not
/// overlap. NaN counts as absent: where some of the sixteen taps are absent, the result is the mean of the
/// others under the magnitudes of their weights (negative weights without their partners could extrapolate
/// without bound), and NaN where none with a weight is left. Values are not scaled: see scaleDisparity().
void bicubicUpscale(ImageView<const float> in, ImageView<float> out, ScaleScratch& scratch,
                    const PyramidKernels& kernels, int threads);

/// Multiplies by `ratio`, the ratio of the widths, once a disparity map has changed its size. NaN stays NaN.
void scaleDisparity(ImageView<float> disparity, float ratio, int threads);

}  // namespace pomona
