#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "camera/calibrate.h"

namespace pomona {
namespace {

constexpr int kCellColumns = 10, kCellRows = 8;

std::vector<const BoardView*> usable(const std::vector<BoardView>& views) {
  std::vector<const BoardView*> result;
  for (const BoardView& view : views)
    if (view.rejected.empty()) result.push_back(&view);
  return result;
}

cv::Mat1b cellsWithCorners(const std::vector<BoardView>& views, cv::Size size, bool right) {
  cv::Mat1b cells = cv::Mat1b::zeros(kCellRows, kCellColumns);
  for (const BoardView* view : usable(views))
    for (const cv::Point2f& p : right ? view->right : view->left) {
      const int x = static_cast<int>(p.x * kCellColumns / static_cast<float>(size.width));
      const int y = static_cast<int>(p.y * kCellRows / static_cast<float>(size.height));
      cells(std::clamp(y, 0, kCellRows - 1), std::clamp(x, 0, kCellColumns - 1)) = 1;
    }
  return cells;
}

}  // namespace

std::array<double, 2> coverageOf(const std::vector<BoardView>& views, cv::Size image_size) {
  std::array<double, 2> share{};
  for (std::size_t i = 0; i < 2; ++i)
    share[i] =
        cv::countNonZero(cellsWithCorners(views, image_size, i == 1)) / (1.0 * kCellRows * kCellColumns);
  return share;
}

cv::Mat coveragePicture(const std::vector<BoardView>& views, cv::Size image_size) {
  const int gap = 8;
  cv::Mat picture(image_size.height, 2 * image_size.width + gap, CV_8UC3, cv::Scalar::all(255));
  const std::vector<const BoardView*> used = usable(views);
  for (int side = 0; side < 2; ++side) {
    cv::Mat part = picture(cv::Rect({side * (image_size.width + gap), 0}, image_size));
    const cv::Mat1b cells = cellsWithCorners(views, image_size, side == 1);
    for (int y = 0; y < part.rows; ++y)
      for (int x = 0; x < part.cols; ++x)
        part.at<cv::Vec3b>(y, x) =
            cv::Vec3b::all(cells(y * kCellRows / part.rows, x * kCellColumns / part.cols) ? 225 : 90);
    for (std::size_t i = 0; i < used.size(); ++i) {
      // Hues around the circle, so that neighbours in the list can be told apart.
      cv::Mat color(1, 1, CV_8UC3, cv::Scalar(static_cast<double>(i * 67 % 180), 230, 190));
      cv::cvtColor(color, color, cv::COLOR_HSV2BGR);
      for (const cv::Point2f& p : side == 1 ? used[i]->right : used[i]->left)
        cv::circle(part, p, std::max(2, image_size.width / 300), cv::Scalar(color.at<cv::Vec3b>(0, 0)),
                   cv::FILLED, cv::LINE_AA);
    }
  }
  return picture;
}

}  // namespace pomona
