#include "datasets/rendering/picture_rays.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/parallel.h"

namespace pomona {

PictureRays::PictureRays(cv::Size size, double focal_px, const cv::Vec2d& principal_px,
                         const std::optional<CameraModel>& lens, int threads)
    : size_(size), focal_(focal_px), principal_(principal_px) {
  if (!lens) return;
  corners_.create(size.height + 1, size.width + 1, CV_64FC2);
  parallelStrips(threads, corners_.rows, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < corners_.cols; ++x)
        corners_.at<cv::Vec2d>(y, x) = lens->directionOf({x - 0.5, y - 0.5});
  });
  if (!cv::checkRange(corners_))
    throw std::invalid_argument("scene: a camera's lens doesn't reach all of its pixels");
}

cv::Vec3d PictureRays::taken(int x, int y, double dx, double dy) const {
  if (corners_.empty()) return ideal(x + dx, y + dy);
  // Within a pixel a lens is linear to 1e-6 px.
  const double a = dx + 0.5, b = dy + 0.5;
  const auto* above = corners_.ptr<cv::Vec2d>(y) + x;
  const auto* below = corners_.ptr<cv::Vec2d>(y + 1) + x;
  const cv::Vec2d d = (above[0] * (1 - a) + above[1] * a) * (1 - b) + (below[0] * (1 - a) + below[1] * a) * b;
  return {d[0], d[1], 1};
}

cv::Rect2d PictureRays::range() const {
  const cv::Vec3d first = ideal(-0.5, -0.5), last = ideal(size_.width - 0.5, size_.height - 0.5);
  cv::Point2d low(first[0], first[1]), high(last[0], last[1]);
  for (int y = 0; y < corners_.rows; ++y)
    for (int x = 0; x < corners_.cols; ++x) {
      const auto& d = corners_.at<cv::Vec2d>(y, x);
      low = {std::min(low.x, d[0]), std::min(low.y, d[1])};
      high = {std::max(high.x, d[0]), std::max(high.y, d[1])};
    }
  return {low, high};
}

}  // namespace pomona
