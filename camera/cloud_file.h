// Coloured point clouds as files: PLY for MeshLab, CloudCompare and Open3D, PCD for the Point Cloud Library,
// ROS and Open3D. Frame: the left camera's, metres, X right, Y down, Z forward.
//
// `colors` is CV_8UC3 (BGR) of the disparity map's size. The functions that have it throw
// std::invalid_argument for anything else, and where pointsFromDisparity() does.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "pomona/calibration.h"

namespace pomona {

/// Binary little-endian PLY: a vertex (float x, y, z; uchar red, green, blue) for every pixel whose depth is
/// known, row by row.
std::string encodePly(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration);

/// The same of single points; all of them are written.
struct CloudPoint {
  cv::Vec3f point_m;
  cv::Vec3b bgr;
};
std::string encodePlyPoints(std::span<const CloudPoint> points);

/// Binary PCD 0.7, organised: WIDTH and HEIGHT are the image's, and pixels of unknown depth are NaN. Fields
/// x y z (float) and rgb, a float whose bits are 0x00RRGGBB, as PCL has it.
std::string encodePcd(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration);

}  // namespace pomona
