#include "camera/seen_share.h"

#include <cmath>

namespace pomona {

double seenShare(const RegionSamples& region, const StereoCalibration& calibration, ParallaxAlong surface,
                 double reach_px) {
  double seen = 0, unseen = 0;
  for (const SurfaceSample& s : region.samples) {
    if (!s.measured) continue;
    const auto parallax_px = surface(s.ray);
    if (parallax_px && std::abs(s.parallax_px - *parallax_px) < reach_px) seen += s.centrality;
  }
  const auto isOutside = [&](double x_px) { return x_px < 0 || x_px > region.view_width_px - 1; };
  for (const UnmeasuredPixel& pixel : region.unmeasured) {
    const auto parallax_px = surface(pixel.ray);
    const bool partner_outside = parallax_px && isOutside(pixel.x_px - *parallax_px + calibration.doffs_px);
    if (!partner_outside) unseen += pixel.centrality;
  }
  return seen > 0 ? seen / (seen + unseen) : 0;
}

}  // namespace pomona
