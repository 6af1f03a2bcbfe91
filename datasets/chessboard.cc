#include "datasets/chessboard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "datasets/hash.h"

namespace pomona {
namespace {

constexpr double kWhite = 220, kBlack = 30, kGround = 115;

void requireDrawable(const CameraModel& camera, const Chessboard& board) {
  if (camera.width <= 0 || camera.height <= 0)
    throw std::invalid_argument("the camera's size is unknown; allowed: 1x1 and more");
  if (board.columns < 2 || board.rows < 2)
    throw std::invalid_argument("board is " + std::to_string(board.columns) + "x" +
                                std::to_string(board.rows) + " inner corners; allowed: 2x2 and more");
  if (!(board.square_m > 0) || !std::isfinite(board.square_m))
    throw std::invalid_argument("square_m is " + std::to_string(board.square_m) + "; allowed: above 0");
}

// Brightness at (u, v), counted in squares from the first inner corner.
double paint(const Chessboard& board, double u, double v) {
  const bool on_sheet = u >= -2 && v >= -2 && u < board.columns + 1 && v < board.rows + 1;
  if (!on_sheet) return kGround;
  const bool on_squares = u >= -1 && v >= -1 && u < board.columns && v < board.rows;
  if (!on_squares) return kWhite;
  return (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) % 2 == 0 ? kBlack : kWhite;
}

// From a direction (x, y, 1) to (u w, v w, w) on the board, in squares.
cv::Matx33d boardFromDirection(const Chessboard& board, const BoardPose& pose) {
  const cv::Matx33d& r = pose.rotation;
  const cv::Vec3d& t = pose.translation_m;
  const double s = board.square_m;
  return cv::Matx33d(s * r(0, 0), s * r(0, 1), t[0], s * r(1, 0), s * r(1, 1), t[1], s * r(2, 0), s * r(2, 1),
                     t[2])
      .inv();
}

// About normal: the sum of 12 numbers in [0, 1) has variance 1.
double noiseAt(std::uint64_t seed, int x, int y) {
  Random random(hash(seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y)) +
                static_cast<std::uint64_t>(x));
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.between(0, 1);
  return sum;
}

// The mean over a pixel with the directions of its four corners, top left, top right, bottom left, bottom
// right: within a pixel a lens is linear to 1e-6 px.
double meanOver(const Chessboard& board, const cv::Matx33d& to_board,
                const std::array<cv::Vec2d, 4>& corners) {
  const auto placeOf = [&](const cv::Vec2d& direction) {
    const cv::Vec3d p = to_board * cv::Vec3d(direction[0], direction[1], 1);
    return p[2] > 0 ? cv::Vec2d(p[0] / p[2], p[1] / p[2]) : cv::Vec2d(-1e9, -1e9);
  };
  const auto squareOf = [&](const cv::Vec2d& direction) {
    const cv::Vec2d place = placeOf(direction);
    return cv::Vec2d(std::floor(place[0]), std::floor(place[1]));
  };
  const cv::Vec2d square = squareOf(corners[0]);
  if (std::all_of(corners.begin() + 1, corners.end(), [&](const auto& c) { return squareOf(c) == square; }))
    return paint(board, square[0], square[1]);
  constexpr int kRays = 8;
  double sum = 0;
  for (int j = 0; j < kRays; ++j)
    for (int i = 0; i < kRays; ++i) {
      const double a = (i + 0.5) / kRays, b = (j + 0.5) / kRays;
      const cv::Vec2d place = placeOf((corners[0] * (1 - a) + corners[1] * a) * (1 - b) +
                                      (corners[2] * (1 - a) + corners[3] * a) * b);
      sum += paint(board, place[0], place[1]);
    }
  return sum / (kRays * kRays);
}

bool seesWholeBoard(const CameraModel& camera, const Chessboard& board, const BoardPose& pose) {
  constexpr double kMargin_px = 10;
  for (const double u : {-2.0, board.columns + 1.0})
    for (const double v : {-2.0, board.rows + 1.0}) {
      const cv::Vec3d p =
          pose.rotation * cv::Vec3d(u * board.square_m, v * board.square_m, 0) + pose.translation_m;
      if (p[2] <= 0) return false;
      const cv::Vec2d pixel = camera.pixelOf({p[0] / p[2], p[1] / p[2]});
      if (!(pixel[0] >= kMargin_px && pixel[1] >= kMargin_px && pixel[0] <= camera.width - kMargin_px &&
            pixel[1] <= camera.height - kMargin_px))
        return false;
    }
  return true;
}

cv::Matx33d turned(double x, double y, double z) {
  const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y), cz = std::cos(z),
               sz = std::sin(z);
  return cv::Matx33d(cz, -sz, 0, sz, cz, 0, 0, 0, 1) * cv::Matx33d(cy, 0, sy, 0, 1, 0, -sy, 0, cy) *
         cv::Matx33d(1, 0, 0, 0, cx, -sx, 0, sx, cx);
}

}  // namespace

ChessboardRenderer::ChessboardRenderer(const CameraModel& camera, const Chessboard& board) : board_(board) {
  requireDrawable(camera, board);
  directions_.create(camera.height + 1, camera.width + 1, CV_64FC2);
  parallelStrips(availableThreads(), directions_.rows, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < directions_.cols; ++x)
        directions_.at<cv::Vec2d>(y, x) = camera.directionOf({x - 0.5, y - 0.5});
  });
}

cv::Mat ChessboardRenderer::render(const BoardPose& pose, double noise, std::uint64_t seed) const {
  const cv::Matx33d to_board = boardFromDirection(board_, pose);
  cv::Mat image(directions_.rows - 1, directions_.cols - 1, CV_8UC1);
  parallelStrips(availableThreads(), image.rows, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.cols; ++x) {
        const auto* above = directions_.ptr<cv::Vec2d>(y) + x;
        const auto* below = directions_.ptr<cv::Vec2d>(y + 1) + x;
        double value = meanOver(board_, to_board, {above[0], above[1], below[0], below[1]});
        if (noise > 0) value = std::clamp(value + noise * noiseAt(seed, x, y), 0.0, 255.0);
        image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(value + 0.5);
      }
  });
  return image;
}

std::vector<BoardPose> scatteredPoses(const StereoRig& rig, const Chessboard& board, int count,
                                      std::uint64_t seed) {
  requireDrawable(rig.left, board);
  requireDrawable(rig.right, board);
  constexpr int kMostTries = 100'000;
  constexpr double kTilt = 0.7, kRoll = 0.4;  // radians
  Random random(seed);
  const cv::Vec3d center(board.square_m * (board.columns - 1) / 2, board.square_m * (board.rows - 1) / 2, 0);
  // The distance at which the board is as wide as the image.
  const double nearest_m = board.square_m * (board.columns + 3) * rig.left.fx_px / rig.left.width;
  std::vector<BoardPose> poses;
  for (int i = 0; i < kMostTries && static_cast<int>(poses.size()) < count; ++i) {
    BoardPose pose;
    const double tilt_x = random.between(-kTilt, kTilt), tilt_y = random.between(-kTilt, kTilt);
    pose.rotation = turned(tilt_x, tilt_y, random.between(-kRoll, kRoll));
    const double z = nearest_m * random.between(1.0, 2.5);
    const double x = random.between(0, rig.left.width), y = random.between(0, rig.left.height);
    const cv::Vec2d direction = rig.left.directionOf({x, y});
    pose.translation_m = cv::Vec3d(direction[0] * z, direction[1] * z, z) - pose.rotation * center;
    if (seesWholeBoard(rig.left, board, pose) && seesWholeBoard(rig.right, board, seenFromRight(rig, pose)))
      poses.push_back(pose);
  }
  if (static_cast<int>(poses.size()) < count)
    throw std::invalid_argument("the cameras of this rig hardly ever see the whole board at once");
  return poses;
}

BoardPose seenFromRight(const StereoRig& rig, const BoardPose& pose) {
  return {rig.right_from_left_rotation * pose.rotation,
          rig.right_from_left_rotation * pose.translation_m + rig.right_from_left_m};
}

}  // namespace pomona
