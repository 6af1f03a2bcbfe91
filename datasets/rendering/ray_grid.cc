#include "datasets/rendering/ray_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pomona {
namespace {

using cv::Vec3d;

constexpr double kMargin = 1e-6;  // of a direction: far more than rounding, far less than a pixel

// What a box spans in a frame that looks along +Z.
struct Span {
  double left = kNowhere, right = -kNowhere, top = kNowhere, bottom = -kNowhere;
  double nearest = kNowhere;
};
Span spanOf(const Bounds& bounds, const Vec3d& origin, const cv::Matx33d& axes) {
  Span span;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d p;
    for (int i = 0; i < 3; ++i) p[i] = (corner >> i & 1 ? bounds.high : bounds.low)[i];
    p = axes * (p - origin);
    const double x = p[0] / p[2], y = p[1] / p[2];
    span.left = std::min(span.left, x);
    span.right = std::max(span.right, x);
    span.top = std::min(span.top, y);
    span.bottom = std::max(span.bottom, y);
    span.nearest = std::min(span.nearest, p[2]);
  }
  return span;
}

}  // namespace

RayGrid::RayGrid(std::span<const Solid> solids, const Vec3d& origin, const cv::Matx33d& axes,
                 const cv::Rect2d& range, cv::Size cells, Beyond beyond)
    : origin_(origin), axes_(axes), range_(range), cells_(cells), lists_(cells.area()) {
  for (const Solid& solid : solids) add(solid, beyond);
  for (auto& list : lists_)
    std::stable_sort(list.begin(), list.end(),
                     [](const Candidate& a, const Candidate& b) { return a.nearest < b.nearest; });
}

void RayGrid::add(const Solid& solid, Beyond beyond) {
  const Span span = spanOf(solid.bounds(), origin_, axes_);
  cv::Rect covered(0, 0, cells_.width, cells_.height);
  const bool in_front = span.nearest > kNearest_m;
  if (in_front) {
    const bool outside = span.right < range_.x - kMargin || span.left > range_.br().x + kMargin ||
                         span.bottom < range_.y - kMargin || span.top > range_.br().y + kMargin;
    if (outside && beyond == Beyond::kNothing) return;
    const cv::Point first(columnOf(span.left - kMargin), rowOf(span.top - kMargin));
    const cv::Point last(columnOf(span.right + kMargin), rowOf(span.bottom + kMargin));
    covered = cv::Rect(first, last + cv::Point(1, 1));
  }
  for (int row = covered.y; row < covered.y + covered.height; ++row)
    for (int column = covered.x; column < covered.x + covered.width; ++column)
      lists_[row * cells_.width + column].push_back({&solid, in_front ? span.nearest : 0});
}

int RayGrid::columnOf(double x) const {
  return static_cast<int>(std::clamp((x - range_.x) / range_.width * cells_.width, 0.0, cells_.width - 1.0));
}
int RayGrid::rowOf(double y) const {
  return static_cast<int>(
      std::clamp((y - range_.y) / range_.height * cells_.height, 0.0, cells_.height - 1.0));
}

const std::vector<RayGrid::Candidate>& RayGrid::candidates(const Vec3d& local_direction) const {
  const int column = columnOf(local_direction[0] / local_direction[2]);
  const int row = rowOf(local_direction[1] / local_direction[2]);
  return lists_[row * cells_.width + column];
}

Hit RayGrid::firstHit(const Vec3d& direction) const {
  const Vec3d local = axes_ * direction;
  Hit hit;
  for (const Candidate& candidate : candidates(local)) {
    if (candidate.nearest > hit.depth * local[2]) break;
    const double depth = candidate.solid->depthAlong(origin_, direction);
    if (depth < hit.depth || (depth == hit.depth && candidate.solid < hit.solid))
      hit = {candidate.solid, depth};
  }
  return hit;
}

bool RayGrid::isBlocked(const Vec3d& direction, double depth) const {
  const Vec3d local = axes_ * direction;
  for (const Candidate& candidate : candidates(local)) {
    if (candidate.nearest > depth * local[2]) return false;
    if (candidate.solid->shape != Shape::kPlane && candidate.solid->depthAlong(origin_, direction) < depth)
      return true;
  }
  return false;
}

cv::Rect2d busyRange(std::span<const Solid> solids, const Vec3d& origin, const cv::Matx33d& axes) {
  std::vector<double> xs, ys;
  for (const Solid& solid : solids) {
    const Vec3d p = axes * (solid.center - origin);
    if (solid.shape == Shape::kPlane || !(p[2] > kNearest_m)) continue;
    xs.push_back(p[0] / p[2]);
    ys.push_back(p[1] / p[2]);
  }
  if (xs.empty()) return {0, 0, 1, 1};
  const auto inner = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    const double low = values[values.size() / 20], high = values[values.size() - 1 - values.size() / 20];
    return std::pair(low, std::max(high - low, 1e-3));
  };
  const auto [x, width] = inner(xs);
  const auto [y, height] = inner(ys);
  return {x, y, width, height};
}

}  // namespace pomona
