// Values for the pixels that validation rejected, taken from what lies around them.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "core/parallel.h"
#include "pyramid/kernels.h"

namespace pomona {

/// Everything has the size of the left image. Sides are at most 65535, stride times height is below 2^31.
struct HoleFillInput {
  GuideView guide;                         ///< the left image
  ImageView<const float> right_disparity;  ///< the right view's map, d = x_left - x_right; NaN where unknown
  /// The last resort, asked for only if a hole needs it: a map in pixels of this one; may be empty or hold
  /// NaN.
  FunctionRef<ImageView<const float>()> coarse;
  int search_radius_px = 200;    ///< length of a search ray, >= 0
  float fallback_disparity = 0;  ///< where the whole map offers nothing
};

/// Gives every pixel that is not measured, filled or kMasked a disparity and a filled state, in place.
///
/// Sources are the measured pixels (state kMeasured, disparity not NaN) and those of state kFilledPlane;
/// they, other filled and masked pixels stay as they are. From a hole p = (x, y), 4 rays, to the left and
/// right, up and down, run, across masked pixels too, to their first source within the search radius. Its
/// disparity e is a candidate of weight
///     exp(-|I(p) - I(source)| / 12 - length / 30)
/// with |.| the mean over channels in 8-bit units, and the length in pixels. A candidate is impossible, and
/// dropped, if the right view sees something at x - e (nearest pixel, inside the image) that is farther than
/// e by more than 1.5 px of disparity: a surface at e would hide it from there.
///
/// - The weighted (lower) median of the candidates. State kFilledBackground for occluded and out-of-range
///   pixels, whose possible candidates are those of the background, kFilledInterpolated for others.
/// - No possible candidate: the smaller of the sources to the left and right, or without these of all.
/// - No source within reach: the coarse map's value. State kFilledCoarse.
/// - Nor that: the nearest value in the row, or else in the column, at any distance (of two as near, the
///   smaller); else `fallback_disparity`. State as by the first rule.
///
/// Weights are integers (the product of both exponentials in 1 / 65535, over 16, at least 1), so that their
/// sums are exact and the result depends on nothing but the input. The rays of all pixels are followed
/// together, one step per row and ray: time grows with the number of pixels, not with the size of the holes.
void fillHoles(const HoleFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
               Arena& scratch, const PyramidKernels& kernels, int threads);

}  // namespace pomona
