// The surface, of any shape, that most of a region's pixels lie on.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "camera/region.h"

namespace pomona {

struct FittedSurface {
  cv::Point2d middle_px;   ///< of the pixels on it
  double parallax_px = 0;  ///< their mean
  double variance_px2 = 0;
  double support_px = 0;
};

/// How far off the peak a pixel may be.
inline constexpr double kSurfaceReach_px = 2;

/// Each pixel votes for its own parallax, with its trust and a weight that falls from the outline's middle;
/// then the mean of those near the peak. None if there is no vote.
std::optional<FittedSurface> fitSurface(const RegionSamples& region);

}  // namespace pomona
