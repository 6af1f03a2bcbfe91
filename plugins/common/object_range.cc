#include "plugins/common/object_range.h"

#include <cmath>
#include <optional>
#include <string>

#include "plugins/common/disparity_plane.h"
#include "plugins/common/triangulation.h"

namespace pomona {
namespace {

constexpr int kLeastPoints = 3;

void fail(std::size_t points, SparseObject& object) {
  object.why_not = "seen, but only " + std::to_string(points) + " of at least " +
                   std::to_string(kLeastPoints) + " features could be ranged";
}

// `sigma_m` is that of Z; along the line of sight it is longer as the distance is.
void setPoint(const cv::Point3d& point_m, double sigma_m, int support, SparseObject& object) {
  object.point_m = point_m;
  object.distance_m = distanceOf(point_m);
  object.sigma_m = sigma_m * object.distance_m / point_m.z;
  object.bearing_deg = bearingOf(point_m);
  object.support = support;
}

}  // namespace

void rangeByMean(const std::vector<SparsePoint>& points, SparseObject& object) {
  if (static_cast<int>(points.size()) < kLeastPoints) return fail(points.size(), object);
  double sum = 0, squares = 0;
  for (const SparsePoint& point : points) sum += point.point_m.z;
  const double mean = sum / static_cast<double>(points.size());
  for (const SparsePoint& point : points) squares += (point.point_m.z - mean) * (point.point_m.z - mean);
  const double deviation = std::sqrt(squares / static_cast<double>(points.size()));
  cv::Point3d middle;
  int kept = 0;
  for (const SparsePoint& point : points) {
    if (std::abs(point.point_m.z - mean) > deviation) continue;
    middle += cv::Point3d(point.point_m);
    ++kept;
  }
  if (kept == 0) return fail(0, object);
  setPoint(middle * (1.0 / kept), deviation / std::sqrt(static_cast<double>(kept)), kept, object);
}

void rangeByPlane(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& rig,
                  const std::vector<SparsePoint>& points, const cv::Point2d& middle_px,
                  SparseObject& object) {
  constexpr double kTolerance_px = 1;
  std::vector<PlaceDisparity> disparities;
  for (const SparsePoint& point : points) disparities.push_back({point.left_px, point.disparity_px});
  std::optional<DisparityPlane> plane =
      fitDisparityPlane(disparities, middle_px, kTolerance_px, kLeastPoints);
  if (!plane) return fail(points.size(), object);
  // Where the views can't be aligned, as on a glossy sign, the features' own plane it is.
  if (const auto aligned = alignDisparityPlane(left, right, object.outline_px, *plane)) plane = aligned;
  const cv::Point2f at = middle_px;
  const cv::Point2f partner(static_cast<float>(middle_px.x - plane->disparity_px), at.y);
  const SparsePoint point = triangulate(rig, at, partner, static_cast<float>(plane->sigma_px));
  if (!std::isfinite(point.point_m.z)) return fail(0, object);
  setPoint(point.point_m, point.sigma_z_m, static_cast<int>(points.size()), object);
}

double largestDisparity(const StereoCalibration& rig, const cv::Mat& view) {
  return rig.num_disparities > 0 ? rig.num_disparities : view.cols / 3.0;
}

}  // namespace pomona
