// The sphere that most of a region's pixels lie on.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/region.h"
#include "pomona/calibration.h"

namespace pomona {

/// What was known of a sphere's radius before looking.
struct RadiusPrior {
  double radius_m = 0, sigma_m = 0;  ///< 0: unknown
};

struct FittedSphere {
  cv::Vec3d center_m;
  double radius_m = 0;
  cv::Matx44d covariance;  ///< of the centre (x, y, z) and the radius, in m^2, without errors of shape
  double support_px = 0;   ///< pixels that lie on it
  /// How much speaks for it: the share of the region's central trust that lies on it, less twice that which
  /// was measured, not filled, well behind it, so that it is seen through it; less where its radius is not
  /// the expected one; at most 1.
  double score = 0;
};

/// The parallax of the sphere's near side along the ray, in pixels; none beside it, or if that side is not
/// before the camera, which is in the sphere or beyond it.
std::optional<double> parallaxAlong(const cv::Vec3d& ray, const FittedSphere& sphere,
                                    const StereoCalibration& calibration);

/// First guesses by voting. A sphere of angular radius alpha around the bearing b that touches the surface
/// point seen along the ray r at parallax p has the centre's parallax
///
///     q = p r_z cos^2(alpha) / (c + sqrt(c^2 - cos^2(alpha))),     c = r b >= cos(alpha)
///
/// measured along b: the factor of p depends on the place in the image alone. So for each b and alpha every
/// pixel votes for one q, with its trust and a weight that falls from the middle of the outline; those on a
/// sphere like that vote for the same. Of a coarse grid of b and alpha around the outline's, those with most
/// votes within 1/2 px: up to eight, at least 1/2 px apart, best first. Of the spheres only centre and radius
/// are set.
std::vector<FittedSphere> vote(const RegionSamples& region, const Outline& outline, const RadiusPrior& prior,
                               const StereoCalibration& calibration);

/// Refines a guess: least squares in pixels of disparity over the samples, weighted by trust and sigma_px,
/// without those that are off by too much (Tukey's biweight, which at first reaches half as far towards the
/// camera as away from it) or on the sphere's rim, where matching windows reach beyond it. The outline says
/// how large the sphere is, roughly, where the prior doesn't. None if the samples do not determine one.
std::optional<FittedSphere> refine(const FittedSphere& guess, const RegionSamples& region,
                                   const Outline& outline, const RadiusPrior& prior,
                                   const StereoCalibration& calibration);

}  // namespace pomona
