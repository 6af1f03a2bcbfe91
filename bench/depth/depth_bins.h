// The pixels of a scene by their true depth, each with the depth that was measured.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bench/fruits/distance_errors.h"
#include "pomona/calibration.h"
#include "pomona/disparity.h"

namespace pomona {

/// Depths from nearest_m on, up to below farthest_m.
struct DepthBin {
  double nearest_m, farthest_m;
  std::vector<MeasuredDistance> pixels;
};

/// Bins of `bin_m` from 0 on, the nearest first, without the empty ones. `truth_px`: CV_32F of the map's
/// size; pixels where it is not finite, or at infinity, are left out. The map's sigma_px may be empty. Throws
/// std::invalid_argument for maps that don't fit each other or the calibration, or bin_m <= 0.
std::vector<DepthBin> depthBins(const StereoResult& map, const cv::Mat& truth_px,
                                const StereoCalibration& calibration, double bin_m);

/// A method's errors, bin by bin.
struct DepthErrors {
  std::string method;
  std::vector<DepthBin> bins;  ///< of the same scene for all methods
};

/// Markdown: a row for every bin, with the columns of each method; what one pixel of disparity is worth in
/// the bin's middle.
std::string depthTable(const std::vector<DepthErrors>& methods, const StereoCalibration& calibration);

}  // namespace pomona
