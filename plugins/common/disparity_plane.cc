#include "plugins/common/disparity_plane.h"

#include <algorithm>
#include <cmath>

#include "datasets/hash.h"

namespace pomona {
namespace {

std::optional<DisparityPlane> leastSquares(const std::vector<PlaceDisparity>& points,
                                           const cv::Point2d& origin) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right_side;
  for (const PlaceDisparity& point : points) {
    const cv::Vec3d row(1, point.left_px.x - origin.x, point.left_px.y - origin.y);
    normal += row * row.t();
    right_side += row * point.disparity_px;
  }
  // Places on one line leave a slope open.
  constexpr double kLeastSpread = 1e-6;
  const double scale = normal(0, 0) * normal(1, 1) * normal(2, 2);
  if (!(cv::determinant(normal) > kLeastSpread * scale)) return std::nullopt;
  const cv::Vec3d solution = normal.solve(right_side, cv::DECOMP_CHOLESKY);
  return DisparityPlane{origin, solution[0], solution[1], solution[2]};
}

std::vector<PlaceDisparity> agreeing(const std::vector<PlaceDisparity>& points, const DisparityPlane& plane,
                                     double tolerance_px) {
  std::vector<PlaceDisparity> agree;
  for (const PlaceDisparity& point : points)
    if (std::abs(plane.at(point.left_px) - point.disparity_px) <= tolerance_px) agree.push_back(point);
  return agree;
}

}  // namespace

std::optional<DisparityPlane> fitDisparityPlane(const std::vector<PlaceDisparity>& points,
                                                const cv::Point2d& origin_px, double tolerance_px,
                                                int min_agreeing) {
  constexpr int kTriples = 300;
  if (points.size() < 3) return std::nullopt;
  Random random(points.size());
  const auto pick = [&] {
    return points[static_cast<std::size_t>(random.between(0, double(points.size())))];
  };
  std::vector<PlaceDisparity> best;
  for (int i = 0; i < kTriples; ++i) {
    const auto plane = leastSquares({pick(), pick(), pick()}, origin_px);
    if (!plane) continue;
    std::vector<PlaceDisparity> agree = agreeing(points, *plane, tolerance_px);
    if (agree.size() > best.size()) best = std::move(agree);
  }
  if (static_cast<int>(best.size()) < std::max(3, min_agreeing)) return std::nullopt;
  std::optional<DisparityPlane> plane = leastSquares(best, origin_px);
  if (!plane) return std::nullopt;
  double squares = 0;
  for (const PlaceDisparity& point : best) {
    const double off = plane->at(point.left_px) - point.disparity_px;
    squares += off * off;
  }
  const double freedom = std::max(1.0, double(best.size()) - 3);
  plane->sigma_px = std::sqrt(squares / freedom / double(best.size()));
  return plane;
}

}  // namespace pomona
