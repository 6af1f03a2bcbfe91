#include "datasets/rendering/picture_paint.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

cv::Mat halved(const cv::Mat& picture) {
  cv::Mat half((picture.rows + 1) / 2, (picture.cols + 1) / 2, CV_8UC3);
  for (int y = 0; y < half.rows; ++y)
    for (int x = 0; x < half.cols; ++x) {
      const int x0 = 2 * x, y0 = 2 * y;
      const int x1 = std::min(x0 + 1, picture.cols - 1), y1 = std::min(y0 + 1, picture.rows - 1);
      const auto &a = picture.at<cv::Vec3b>(y0, x0), &b = picture.at<cv::Vec3b>(y0, x1),
                 &c = picture.at<cv::Vec3b>(y1, x0), &d = picture.at<cv::Vec3b>(y1, x1);
      for (int k = 0; k < 3; ++k)
        half.at<cv::Vec3b>(y, x)[k] = static_cast<std::uint8_t>((a[k] + b[k] + c[k] + d[k] + 2) / 4);
    }
  return half;
}

}  // namespace

std::vector<cv::Mat> reductionsOf(const cv::Mat& picture) {
  std::vector<cv::Mat> reductions{picture};
  while (reductions.back().rows > 1 && reductions.back().cols > 1)
    reductions.push_back(halved(reductions.back()));
  return reductions;
}

cv::Vec3d pictureAt(const std::vector<cv::Mat>& reductions, double x, double y, double pixel) {
  std::size_t level = 0;
  while (level + 1 < reductions.size() && pixel * reductions[level].cols > 2) ++level;
  const cv::Mat& picture = reductions[level];
  // Odd sides were rounded up: a reduction's last pixel may reach beyond the picture.
  const double scale = static_cast<double>(1 << level);
  const double at_x = std::clamp(x * reductions[0].cols / scale - 0.5, 0.0, picture.cols - 1.0);
  const double at_y = std::clamp(y * reductions[0].rows / scale - 0.5, 0.0, picture.rows - 1.0);
  const int x0 = static_cast<int>(at_x), y0 = static_cast<int>(at_y);
  const int x1 = std::min(x0 + 1, picture.cols - 1), y1 = std::min(y0 + 1, picture.rows - 1);
  const auto mixed = [](const cv::Vec3d& a, const cv::Vec3d& b, double share) { return a + (b - a) * share; };
  const auto row = [&](int i) {
    return mixed(picture.at<cv::Vec3b>(i, x0), picture.at<cv::Vec3b>(i, x1), at_x - x0);
  };
  return mixed(row(y0), row(y1), at_y - y0);
}

}  // namespace pomona
