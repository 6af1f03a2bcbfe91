// What a disparity map knows of a region.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pomona/measure.h"

namespace pomona {

/// A region's outline: also what of it lies outside of the image.
struct Outline {
  cv::Point2d center_px;
  double radius_px = 0;  ///< half of its larger side
};
/// Throws std::invalid_argument for a region that is empty, not finite or, as a mask, not of size `image`.
Outline outlineOf(const Region& region, cv::Size image);

/// The part of the image that the region lies in, and which pixels of it are inside.
struct RegionMask {
  cv::Rect box;
  cv::Mat1b inside;  ///< of the box's size, 0 outside
  int pixels = 0;    ///< inside
};
RegionMask maskOf(const Region& region, cv::Size image);

/// A pixel with a disparity.
struct SurfaceSample {
  cv::Vec3d ray;  ///< unit vector of its line of sight
  double x_px, y_px;
  double parallax_px;  ///< d + doffs, > 0
  double sigma_px;
  double trust;  ///< 0 to 1
  /// A bell around the outline's middle that is down to a fifth at its radius: detectors put the object in
  /// the middle.
  double centrality;
  double central_trust;  ///< trust times centrality
  bool measured;         ///< not filled
};
/// A pixel that was not measured, whether filled or not. Masked ones are none.
struct UnmeasuredPixel {
  cv::Vec3d ray;
  double x_px;
  double centrality;
};
struct RegionSamples {
  std::vector<SurfaceSample> samples;
  std::vector<UnmeasuredPixel> unmeasured;
  int known_px = 0;        ///< pixels of the region with a disparity
  int infinite_px = 0;     ///< of these, with d + doffs <= 0
  double pixels_each = 1;  ///< pixels that each sample stands for
  int view_width_px = 0;   ///< of both views
};
/// Every pixel inside, or a grid of them that holds `most` at most, about.
RegionSamples samplesOf(const StereoResult& result, const StereoCalibration& calibration,
                        const Outline& outline, const RegionMask& mask, int most);

}  // namespace pomona
