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
  int width = 0, height = 0;  ///< of the images the figures belong to; both 0 if unknown
  int num_disparities = 0;    ///< a conservative bound on the disparities in the scene; 0 if unknown

  /// Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

/// CV_32F metres along the optical axis (REP-118): NaN where the disparity is unknown, or where d + doffs <=
/// 0. This and the next two throw std::invalid_argument if `calibration` is not valid, or for a map that is
/// not CV_32F and of the calibration's size.
cv::Mat depthFromDisparity(const cv::Mat& disparity, const StereoCalibration& calibration);

/// What StereoResult::sigma_px means for the depth: CV_32F metres, Z^2 / (f B) sigma_px; NaN where the depth
/// is. It holds while sigma_px is small beside d + doffs.
cv::Mat depthSigma(const cv::Mat& disparity, const cv::Mat& sigma_px, const StereoCalibration& calibration);

/// The organised point cloud: CV_32FC3, for each pixel (X, Y, Z) in metres in the left camera's frame, X
/// right, Y down, Z forward; three NaN where the depth is unknown.
cv::Mat pointsFromDisparity(const cv::Mat& disparity, const StereoCalibration& calibration);

}  // namespace pomona
