#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "camera/calibrate.h"

namespace pomona {
namespace {

cv::Mat grayOf(const cv::Mat& image) {
  cv::Mat gray = image;
  if (image.channels() == 3) cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

double smallestSpacing(const std::vector<cv::Point2f>& corners, int columns) {
  double smallest = INFINITY;
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % width + 1 < width) smallest = std::min(smallest, cv::norm(corners[i + 1] - corners[i]));
    if (i + width < corners.size()) smallest = std::min(smallest, cv::norm(corners[i + width] - corners[i]));
  }
  return smallest;
}

bool findCorners(const cv::Mat& gray, const BoardSize& board, std::vector<cv::Point2f>& corners) {
  const cv::Size size(board.columns, board.rows);
  // Some boards are found only as they are, others only with their grays stretched. (OpenCV's other finder,
  // findChessboardCorners, finds no more of ours, and takes minutes for a board of another size before
  // noise.)
  const bool found = cv::findChessboardCornersSB(gray, size, corners, cv::CALIB_CB_EXHAUSTIVE) ||
                     cv::findChessboardCornersSB(gray, size, corners,
                                                 cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_NORMALIZE_IMAGE);
  if (!found) return false;
  // The window must not reach the next corner, or that one draws the estimate towards itself.
  constexpr double kShareOfSpacing = 0.2;
  const int reach =
      std::clamp(static_cast<int>(kShareOfSpacing * smallestSpacing(corners, board.columns)), 2, 11);
  cv::cornerSubPix(gray, corners, cv::Size(reach, reach), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4));
  return true;
}

}  // namespace

void BoardSize::validate() const {
  constexpr int kFewest = 3, kMost = 100;
  if (std::min(columns, rows) < kFewest || std::max(columns, rows) > kMost)
    throw std::invalid_argument("board is " + std::to_string(columns) + "x" + std::to_string(rows) +
                                "; allowed: 3x3 to 100x100 inner corners");
  if (!(square_m > 0) || !std::isfinite(square_m))
    throw std::invalid_argument("square_m is " + std::to_string(square_m) + "; allowed: above 0");
}

BoardView findBoard(const std::string& name, const cv::Mat& left, const cv::Mat& right,
                    const BoardSize& board) {
  board.validate();
  BoardView view{name, {}, {}, ""};
  for (const cv::Mat* image : {&left, &right})
    if (image->empty() || image->depth() != CV_8U || (image->channels() != 1 && image->channels() != 3)) {
      view.rejected = "the images are no 8-bit ones with 1 or 3 channels";
      return view;
    }
  if (left.size() != right.size()) {
    view.rejected = "left and right differ in size";
    return view;
  }
  const bool in_left = findCorners(grayOf(left), board, view.left);
  const bool in_right = findCorners(grayOf(right), board, view.right);
  if (!in_left || !in_right) {
    view.rejected = "no complete board of " + std::to_string(board.columns) + "x" +
                    std::to_string(board.rows) + " inner corners in " +
                    (in_left    ? "the right image"
                     : in_right ? "the left image"
                                : "either image");
    return view;
  }
  // On a board that looks the same upside down, the two searches may begin at opposite corners.
  const cv::Point2f along_left = view.left.back() - view.left.front();
  const cv::Point2f along_right = view.right.back() - view.right.front();
  if (along_left.dot(along_right) < 0) std::reverse(view.right.begin(), view.right.end());
  return view;
}

}  // namespace pomona
