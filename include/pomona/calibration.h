// What turns disparity into metres.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// A rectified pair's geometry. Z = focal_px * baseline_m / (d + doffs_px).
struct StereoCalibration {
  double focal_px = 0;  ///< focal length of both rectified views
  double cx_px = 0;     ///< principal point of the left view
  double cy_px = 0;
  double baseline_m = 0;      ///< distance between the cameras, > 0
  double doffs_px = 0;        ///< cx_right - cx_left
  int width = 0, height = 0;  ///< of the images the figures belong to; 0 if unknown
  int num_disparities = 0;    ///< a conservative bound on the disparities in the scene; 0 if unknown

  /// Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

/// CV_32F metres along the optical axis (REP-118): NaN where the disparity is unknown, or where d + doffs <=
/// 0.
cv::Mat depthFromDisparity(const cv::Mat& disparity, const StereoCalibration& calibration);

}  // namespace pomona
