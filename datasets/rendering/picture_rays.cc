#include "datasets/rendering/picture_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/parallel.h"

namespace pomona {
namespace {

// NaN where the lens has none.
cv::Vec2d directionOf(const PictureCamera& camera, double x, double y) {
  const cv::Vec2d own = camera.model.directionOf({x, y});
  const cv::Vec3d ideal = camera.rotation * cv::Vec3d(own[0], own[1], 1);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return ideal[2] > 0 ? cv::Vec2d(ideal[0] / ideal[2], ideal[1] / ideal[2]) : cv::Vec2d(kNan, kNan);
}

}  // namespace

PictureRays::PictureRays(cv::Size size, double focal_px, const cv::Vec2d& principal_px,
                         const std::optional<PictureCamera>& camera, int threads)
    : size_(size), focal_(focal_px), principal_(principal_px) {
  if (!camera) return;
  corners_.create(size.height + 1, size.width + 1, CV_64FC2);
  parallelStrips(threads, corners_.rows, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < corners_.cols; ++x)
        corners_.at<cv::Vec2d>(y, x) = directionOf(*camera, x - 0.5, y - 0.5);
  });
  if (!cv::checkRange(corners_)) throw std::invalid_argument("scene: some pixels of a camera look nowhere");
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
