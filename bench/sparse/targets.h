// Targets at known distances before the sensor of the published four-direction Sobel method.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pomona/calibration.h"

namespace pomona {

/// A card before a wall.
struct TargetPair {
  cv::Mat left, right;
  cv::Mat depth_m;  ///< CV_32F, the true depths Z of the left view
  cv::Mat mask;     ///< CV_8U: where the left view shows the card and the right one does, too
  StereoCalibration calibration;
};

/// One bin of distances, and the mean relative error that is published for it.
struct DistanceBin {
  double nearest_m, farthest_m, published_percent;
};
/// 0.1 - 1, 1 - 2, 2 - 3 and 3 - 10 m.
const std::vector<DistanceBin>& distanceBins();

/// 640 x 480 pixels on a sensor 3.2 mm wide behind a lens of 6 mm, twice, 60 mm apart: f = 1200 px. Such
/// views have nothing in common nearer than 112.5 mm; so the first bin begins at 0.15 m. `count` distances,
/// evenly spread over the bin. Cards 400 mm wide, or 0.3 of what both views see if that is less, turned by up
/// to 30 degrees. The cameras are no ideal ones: blur, vignetting, noise (sigma 2 to 4.5 grey levels), a gain
/// of 1.05 between the views, and rows that are 0.4 px off.
std::vector<TargetPair> targetPairs(const DistanceBin& bin, int count);

}  // namespace pomona
