// How uncertain a calibration is.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "camera/calibrate.h"

namespace pomona {

/// A view's corners and the board that they belong to.
struct Sighting {
  const BoardView* view = nullptr;
  std::size_t index = 0;  ///< of the view in the caller's list
  cv::Vec3d rotation;     ///< left camera from board, as a rotation vector
  cv::Vec3d translation_m;
  double squared_error_px2 = 0;  ///< summed over both cameras' corners
};

/// The board's corners in its own frame.
std::vector<cv::Vec3d> boardCorners(const BoardSize& board);

/// The pose of the board that fits the corners of both cameras best, for a given rig (Gauss-Newton from a
/// pose by the left view alone).
Sighting locateBoard(const BoardView& view, const StereoRig& rig, const std::vector<cv::Vec3d>& corners);

/// Fills in the report's deviations: sigma^2 (J^T J)^-1 of all parameters, poses included, at the optimum;
/// sigma^2 is the mean squared residual per degree of freedom. `coefficients` per camera were fitted.
void estimateDeviations(const std::vector<Sighting>& sightings, const std::vector<cv::Vec3d>& corners,
                        int coefficients, CalibrationReport& report);

}  // namespace pomona
