// Where near things are: the parts of a disparity map in which features are worth looking for.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/calibration.h"

namespace pomona {

struct RegionOptions {
  double far_m = 3;       ///< what is farther than this (depth Z) is background
  int opening_px = 7;     ///< side of the square that opens the near pixels: narrower things go
  int min_area_px = 400;  ///< smaller regions go
  int margin_px = 6;      ///< by which regions grow, so that features on their borders stay whole
};

/// CV_8U, 255 in the regions: connected near pixels of `disparity` (CV_32F, NaN unknown) after the opening.
cv::Mat nearRegions(const cv::Mat& disparity, const StereoCalibration& rig, const RegionOptions& options);

/// The regions as the right view sees them: moved by the disparities in them.
cv::Mat regionsInRightView(const cv::Mat& regions, const cv::Mat& disparity, const RegionOptions& options);

/// A disparity map as cheap as they come: sums of absolute differences over 15 x 15 pixels (cv::StereoBM).
/// CV_32F, NaN unknown. Views: CV_8U, 1 channel.
cv::Mat blockMatchingDisparity(const cv::Mat& left, const cv::Mat& right, int num_disparities);

}  // namespace pomona
