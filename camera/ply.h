// Coloured point clouds as PLY files, which MeshLab, CloudCompare and Open3D open.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "pomona/calibration.h"

namespace pomona {

/// A binary little-endian PLY file with a vertex (float x, y, z in metres; uchar red, green, blue) for every
/// pixel of `disparity` whose depth is known, row by row. Frame: the left camera's, X right, Y down, Z
/// forward. `colors` is CV_8UC3 (BGR) of the same size. Throws std::invalid_argument for anything else.
std::string encodePly(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration);

}  // namespace pomona
