// How much of what a region shows was measured at all.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "camera/region.h"
#include "core/parallel.h"
#include "pomona/calibration.h"

namespace pomona {

/// A surface: its parallax along a ray, in pixels; none beside it.
using ParallaxAlong = FunctionRef<std::optional<double>(const cv::Vec3d& ray)>;

/// How much of an object was measured, if it is `surface`: the measured pixels that lie on it (to within
/// `reach_px`), as a share of these and of all that were not measured, each counted by its centrality. What
/// was not measured may be another object, the one that is meant, which the right view cannot see. Left out
/// are those that the right view cannot see just because they are of this surface: their partners lie outside
/// of it. 0 to 1; 0 if nothing lies on the surface.
double seenShare(const RegionSamples& region, const StereoCalibration& calibration, ParallaxAlong surface,
                 double reach_px);

}  // namespace pomona
