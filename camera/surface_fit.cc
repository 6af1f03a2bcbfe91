#include "camera/surface_fit.h"

#include <algorithm>
#include <cmath>

#include "camera/errors_alike.h"
#include "camera/votes.h"

namespace pomona {

std::optional<FittedSurface> fitSurface(const RegionSamples& region) {
  Votes votes(largestParallax(region));
  for (const SurfaceSample& s : region.samples) votes.add(s.parallax_px, s.central_trust);
  const Votes::Peak peak = votes.peak();
  if (peak.weight <= 0) return {};

  FittedSurface surface;
  double weights = 0, information = 0;
  for (const SurfaceSample& s : region.samples) {
    if (std::abs(s.parallax_px - peak.position) >= kSurfaceReach_px) continue;
    const double sigma_px = std::max(s.sigma_px, kSmallestSigma_px);
    const double weight = s.trust / (sigma_px * sigma_px);
    surface.middle_px += cv::Point2d(s.x_px, s.y_px) * weight;
    surface.parallax_px += s.parallax_px * weight;
    weights += weight;
    information += weight * region.pixels_each / kAlike_px;
    surface.support_px += region.pixels_each;
  }
  if (weights <= 0) return {};
  surface.middle_px *= 1 / weights;
  surface.parallax_px /= weights;
  surface.variance_px2 = 1 / information + kCommonSigma_px * kCommonSigma_px;
  return surface;
}

}  // namespace pomona
