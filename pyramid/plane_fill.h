// Holes filled with the planes that the measured pixels of their colour segments lie on.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// Everything has the size of the left image; sides are at most 32767.
struct PlaneFillInput {
  GuideView guide;                            ///< the left image
  ImageView<const std::uint8_t> left, right;  ///< in gray; empty: no segment is matched as a whole
  ImageView<const float> right_disparity;  ///< the right view's map, d = x_left - x_right; NaN where unknown
  int scale = 4;            ///< segments are found in the image reduced so many times; 1, 2 or 4
  bool fine = true;         ///< both divisions, or only the coarse one
  float min_disparity = 0;  ///< a plane fills with disparities from here ...
  float max_disparity = 0;  ///< ... up to and including here
};

/// Fills holes (see holes.h) of `disparity` in place and gives them state kFilledPlane. Other pixels keep
/// their bytes, and holes that no plane suits stay holes.
///
/// The guide, reduced by area averaging, is divided into segments (see segmentation.h) of at least 100 px of
/// the full image twice, finely with k = 150 / scale and coarsely with k = 1350 / scale. Every segment with
/// holes gets a robust plane (see plane_fit.h) through its sources, one of each block of scale x scale
/// pixels, if there are at least 24 sources, if they are at least 30 % of sources and holes together (2 % in
/// the coarse division), and if half of them lie near the plane. Its holes take the plane's disparities, but
/// none more than 1 px beyond those of the sources near the plane, where they are within the range and hide
/// nothing that the right view sees. The fine division comes first, unless it is left out; the coarse one
/// fills what it leaves, from measured pixels again.
///
/// Segments of which at least 30 % and 100 px are holes, and less than 30 % measured, are also matched as a
/// whole (see segment_match.h). If one level stands out, a plane need not cover so much of the segment; but
/// if it explains the segment worse than the level, by more than 1.5 deviations, the holes take the level.
///
/// Holes beyond the border of the right view (see view_border.h) take no plane that is
/// 1 px or more off the source that they lie beyond; what both divisions leave of them takes that source's
/// disparity, if it belongs to the same coarse segment. The result does not depend on the number of threads.
void fillFromPlanes(const PlaneFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
                    Arena& scratch, const PyramidKernels& kernels, int threads);

}  // namespace pomona
