// What goes into a plugin, and what comes out of it, is checked at the border.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/calibration.h"
#include "pomona/sparse_result.h"

namespace pomona {

/// Throws std::invalid_argument for what LoadedPlugin::run() does not allow.
void checkPluginInputs(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                       const cv::Mat& mask);

/// Throws std::runtime_error for a point of an object that is not there, for pictures that cannot be written,
/// and for names that are no names.
void checkSparseResult(const SparseResult& result);

}  // namespace pomona
