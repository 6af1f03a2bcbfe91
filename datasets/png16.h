// Disparity and depth as 16-bit PNG: a fixed-point number per pixel, 0 where nothing is known.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace pomona {

/// Steps per pixel of disparity.
inline constexpr int kKittiScale = 256;  ///< KITTI 2012 and 2015: 0 .. 255.996 px
inline constexpr int kOpenCvScale = 16;  ///< the x16 of cv::StereoMatcher: 0 .. 4095.94 px

/// A PNG of round(d * scale) for `disparity` (CV_32F, NaN unknown). 0 means unknown, so a known disparity
/// that would round to 0 is stored as 1. OpenCV's own marker for unknown, 16 * (min_disparity - 1), is
/// negative for ranges that start at 0 and has no place in a PNG: 0 stands for it here too. Throws
/// std::invalid_argument naming the first pixel whose disparity is negative or too large to be stored.
std::string encodeDisparityPng(const cv::Mat& disparity, int scale);

/// The reverse: CV_32F, NaN where the file says 0. Throws std::runtime_error for anything but a 16-bit gray
/// PNG.
cv::Mat readDisparityPng(const std::string& path, int scale);

/// A PNG of whole millimetres for `depth_m` (CV_32F metres, NaN unknown), as in REP-118. Depths beyond 65.535
/// m do not fit and are stored as 0, unknown: saturated, they would claim an obstacle where there is none.
std::string encodeDepthPng(const cv::Mat& depth_m);

}  // namespace pomona
