// Middlebury's calib.txt (2014 and later): "key=value" lines with the pair's geometry.
#pragma once

#include <optional>
#include <string>

#include "pomona/calibration.h"

namespace pomona {

struct MiddleburyCalibration {
  StereoCalibration stereo;  ///< width, height and num_disparities (ndisp) are 0 where the file is silent
  bool integer_disparities = false;    ///< isint: the ground truth holds whole numbers only
  std::optional<int> vmin, vmax;       ///< tight bounds on the disparities, pixels
  std::optional<double> dyavg, dymax;  ///< average and largest vertical misalignment, pixels
};

/// Reads cam0=[f 0 cx; 0 f cy; 0 0 1] and baseline (millimetres), which are required; doffs (pixels)
/// or cam1, of which doffs is cx minus cam0's, one of which is; width and height (both, or neither), ndisp,
/// isint, vmin, vmax, dyavg and dymax. Other keys are ignored. Throws std::runtime_error "path: line N: ..."
/// for what cannot be understood or makes no sense.
MiddleburyCalibration readMiddleburyCalibration(const std::string& path);

/// The file for `calibration`; figures that are 0 because they are unknown are left out.
std::string encodeMiddleburyCalibration(const StereoCalibration& calibration);

}  // namespace pomona
