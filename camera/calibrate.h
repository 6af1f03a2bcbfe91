// Stereo calibration from pictures of a chessboard. OpenCV finds the corners and fits the cameras; this adds
// what tells a good calibration from a bad one.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "pomona/rig.h"

namespace pomona {

struct BoardSize {
  int columns = 9, rows = 6;  ///< inner corners, 3 to 100 each
  double square_m = 0;        ///< side of a square, > 0

  /// Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

/// One pair of pictures of the board: its corners in both, or why there are none.
struct BoardView {
  std::string name;                      ///< for reports
  std::vector<cv::Point2f> left, right;  ///< row by row, columns * rows each
  std::string rejected;                  ///< empty: the view can be used
};

/// Finds the board's inner corners, in images of 8 bits with 1 or 3 channels, to a few hundredths of a pixel.
/// A board that one of them doesn't show completely is no error but rejects the view.
BoardView findBoard(const std::string& name, const cv::Mat& left, const cv::Mat& right,
                    const BoardSize& board);

struct CalibrateOptions {
  bool rational = false;  ///< 8 distortion coefficients (k4, k5, k6 as well) for wide lenses, instead of 5
  /// Views whose rms exceeds this many times the median of all views' are rejected; 0 keeps all.
  double outlier_factor = 3;
};

/// Standard deviations of a camera's figures, in their own units.
struct CameraDeviation {
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  std::array<double, 8> distortion{};
};

struct CalibrationReport {
  struct View {
    std::string name;
    std::string rejected;    ///< why it was left out; empty: used
    double rms_px = 0;       ///< of the reprojection errors of both cameras' corners
    double epipolar_px = 0;  ///< mean |y_left - y_right| of its corners, rectified
  };

  StereoRig rig;  ///< with its rectification
  std::vector<View> views;
  int used_views = 0;
  double rms_px = 0;  ///< root of the mean squared distance between corners and the fitted board's
  double epipolar_mean_px = 0, epipolar_p95_px = 0;  ///< |y_left - y_right| of all corners, rectified
  /// Predicted standard deviations: from the scatter of the corners, by the fit's linearisation.
  CameraDeviation left_deviation, right_deviation;
  cv::Vec3d rotation_deviation;  ///< of the rotation vector, radians
  cv::Vec3d translation_deviation_m;
  double baseline_deviation_m = 0;
  double left_coverage = 0, right_coverage = 0;  ///< share of the image's 10 x 8 cells with a corner, 0 to 1
  std::vector<std::string> warnings;             ///< what may make the figures worse than they look
};

/// Leaves out views that repeat others, and those whose left and right corners coincide. Throws
/// std::invalid_argument for a board or a size that cannot be, if fewer than 3 views can be used (saying why
/// each was rejected), or if no possible cameras fit them.
CalibrationReport calibrateStereo(const std::vector<BoardView>& views, cv::Size image_size,
                                  const BoardSize& board, const CalibrateOptions& options = {});

/// Where the corners of the usable views lie: both images side by side, the empty cells of the coverage dark.
/// CV_8UC3.
cv::Mat coveragePicture(const std::vector<BoardView>& views, cv::Size image_size);

/// Share of the image's 10 x 8 cells that hold a corner of a usable view; [0] left, [1] right.
std::array<double, 2> coverageOf(const std::vector<BoardView>& views, cv::Size image_size);

}  // namespace pomona
