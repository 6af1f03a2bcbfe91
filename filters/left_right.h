// Left-right consistency check.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

/// What a row is checked by.
struct LeftRightLimits {
  float threshold_px;  ///< >= 0
  int min_disparity;
  int disparities;  ///< at most kMostCheckedDisparities
};

/// Rejects measured pixels whose match does not point back at them, and tells why (Hirschmueller 2008,
/// sections 2.5 and 2.6.4).
///
/// A pixel takes part if its `state` is PixelState::kMeasured and its `disparity` d (pixels) is not NaN. With
/// x_r the whole number nearest to x - d (halves up), it passes if `right_disparity` is known at x_r and
/// differs from d by at most `threshold_px`. Otherwise its disparity becomes NaN and its state
///   kOutOfRange  if x_r lies outside the image;
///   kMismatched  if its epipolar line meets the right map: some whole disparity e in [min_disparity,
///                min_disparity + disparities) with x - e inside the image has
///                |right_disparity(x - e) - e| <= max(threshold_px, 1), so the point should be visible in
///                both;
///   kOccluded    if not.
///
/// `right_disparity` belongs to the right view and has the same sign convention, d = x_left - x_right; NaN
/// where unknown. All maps have the same size.
void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, const LeftRightLimits& limits,
                    const FilterKernels& kernels, int threads);

/// The same for one row of `width` pixels, which needs no other.
void leftRightCheckRow(float* disparity, std::uint8_t* state, const float* right_disparity, int width,
                       const LeftRightLimits& limits, const FilterKernels& kernels);

}  // namespace pomona
