// Pictures of a chessboard through a known lens: calibration with a known answer.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "pomona/rig.h"

namespace pomona {

/// A chessboard with a white rim as wide as a square. In its frame, inner corner (i, j) is at (i square_m,
/// j square_m, 0): `columns` of them along X, `rows` along Y.
struct Chessboard {
  int columns = 9, rows = 6;  ///< inner corners, at least 2
  double square_m = 0.02;
};

struct BoardPose {
  cv::Matx33d rotation;  ///< camera from board
  cv::Vec3d translation_m;
};

/// Draws a board through one camera's lens.
class ChessboardRenderer {
 public:
  /// Throws std::invalid_argument for a board or a camera (unknown size) that cannot be drawn.
  ChessboardRenderer(const CameraModel& camera, const Chessboard& board);

  /// The board on a gray ground, CV_8UC1. A pixel is the mean of 8 x 8 rays, each of which finds its place on
  /// the board by inverting the lens; then `noise` (standard deviation, 8-bit units) is added, decided by
  /// `seed`. The same for any number of threads.
  cv::Mat render(const BoardPose& pose, double noise = 0, std::uint64_t seed = 0) const;

 private:
  Chessboard board_;
  cv::Mat directions_;  // CV_64FC2: of the pixels' corners
};

/// `count` poses in the left camera's frame, tilted by up to 40 degrees and spread over the image, at which
/// both cameras see the whole board. Throws std::invalid_argument if the rig hardly ever does.
std::vector<BoardPose> scatteredPoses(const StereoRig& rig, const Chessboard& board, int count,
                                      std::uint64_t seed);

/// The same pose as the right camera sees it.
BoardPose seenFromRight(const StereoRig& rig, const BoardPose& pose);

}  // namespace pomona
