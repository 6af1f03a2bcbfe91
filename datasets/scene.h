// One scene of a Middlebury-layout data set: a folder with a rectified pair and what is known about it.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "datasets/middlebury_calib.h"

namespace pomona {

struct Scene {
  cv::Mat left, right;   ///< im0.png, im1.png; as stored, of equal size and type
  cv::Mat ground_truth;  ///< disp0GT.pfm: CV_32F, NaN unknown; empty without the file
  cv::Mat
      nonoccluded;  ///< mask0nocc.png: CV_8U, 255 visible in both views, 128 occluded, 0 unknown; or empty
  std::optional<MiddleburyCalibration> calibration;  ///< calib.txt
};

/// Reads the scene in `folder`. Ground truth and mask, where present, have the size of the left image.
/// Throws std::runtime_error naming the file.
Scene readScene(const std::string& folder);

}  // namespace pomona
