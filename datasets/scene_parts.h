// The files of a pair, each checked to fit the left image. Everything here throws std::runtime_error naming
// the file.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "datasets/middlebury_calib.h"

namespace pomona {

/// Left and right view: of equal size and type, 8 or 16 bits, 1 or 3 channels.
std::pair<cv::Mat, cv::Mat> readViews(const std::string& left_path, const std::string& right_path);

/// One channel of 8 bits, of size `left`.
cv::Mat readByteMap(const std::string& path, cv::Size left);

/// readDisparity(), of size `left`, with known pixels, all of them within four image widths of zero.
cv::Mat readTruth(const std::string& path, cv::Size left);

/// Width and height, where the calibration read from `path` states them, must be those of `left`.
void requireCalibrationFits(const std::string& path, const StereoCalibration& calibration, cv::Size left);

/// The calibration, fitting `left`.
MiddleburyCalibration readCalibration(const std::string& path, cv::Size left);

}  // namespace pomona
