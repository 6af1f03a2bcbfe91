#include "plugins/common/object_range.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

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

void setOutline(const ObjectPlace& place, SparseObject& object) {
  object.outline_px = place.outline_px;
  object.box_px = cv::boundingRect(place.outline_px);
}

using Disparities = std::vector<PlaceDisparity>;

constexpr double kTolerance_px = 1;

int countOn(const DisparityPlane& plane, const Disparities& points) {
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](const PlaceDisparity& point) {
    return std::abs(plane.at(point.left_px) - point.disparity_px) <= kTolerance_px;
  }));
}

// The surface of one disparity that most of the points are on, as if it faced the camera.
DisparityPlane levelOf(const Disparities& points, const cv::Point2d& origin_px) {
  DisparityPlane best{origin_px};
  int most = 0;
  for (const PlaceDisparity& point : points) {
    const DisparityPlane level{origin_px, point.disparity_px};
    if (const int on = countOn(level, points); on > most) most = on, best = level;
  }
  best.sigma_px = kTolerance_px / std::sqrt(std::max(1, most));
  return best;
}

// Nothing if the views can't be aligned, or if that leaves the points: what stands before the surface, or
// beside it, may pull harder than the surface itself.
std::optional<DisparityPlane> alignedFrom(const DisparityPlane& start, const cv::Mat& left,
                                          const cv::Mat& right, const Disparities& points,
                                          const std::vector<cv::Point2f>& outline_px) {
  const auto aligned = alignDisparityPlane(left, right, outline_px, start);
  const bool stays = aligned && 2 * countOn(*aligned, points) >= countOn(start, points);
  return stays ? aligned : std::nullopt;
}

// Its origin is the object's middle. Any three points are on some plane: without the views' word for it, it
// takes twice as many.
std::optional<DisparityPlane> surfaceOf(const cv::Mat& left, const cv::Mat& right,
                                        const std::vector<SparsePoint>& points, const ObjectPlace& place) {
  constexpr int kLeastUnaligned = 2 * kLeastPoints;
  if (static_cast<int>(points.size()) < kLeastPoints) return std::nullopt;
  Disparities disparities;
  for (const SparsePoint& point : points) disparities.push_back({point.left_px, point.disparity_px});
  const auto plane = fitDisparityPlane(disparities, place.middle_px, kTolerance_px, kLeastPoints);
  if (plane) {
    if (const auto aligned = alignedFrom(*plane, left, right, disparities, place.outline_px)) return aligned;
    // Where the views can't be aligned, as on a glossy sign, the features' own plane it is.
    if (countOn(*plane, disparities) >= kLeastUnaligned) return plane;
  }
  const DisparityPlane level = levelOf(disparities, place.middle_px);
  if (const auto aligned = alignedFrom(level, left, right, disparities, place.outline_px)) return aligned;
  return countOn(level, disparities) >= kLeastPoints ? std::optional(level) : std::nullopt;
}

void setMiddle(const StereoCalibration& rig, const DisparityPlane& plane, const ObjectPlace& place,
               std::size_t support, SparseObject& object) {
  const double by_place_px = std::hypot(plane.slope_x, plane.slope_y) * place.middle_sigma_px;
  const cv::Point2f at = place.middle_px;
  const cv::Point2f partner(static_cast<float>(place.middle_px.x - plane.disparity_px), at.y);
  const SparsePoint point =
      triangulate(rig, at, partner, static_cast<float>(std::hypot(plane.sigma_px, by_place_px)));
  if (!std::isfinite(point.point_m.z)) return fail(0, object);
  setPoint(point.point_m, point.sigma_z_m, static_cast<int>(support), object);
}

}  // namespace

void rangeByMean(const std::vector<SparsePoint>& points, const ObjectPlace& place, SparseObject& object) {
  setOutline(place, object);
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

std::vector<SparsePoint> rangeByPlane(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& rig,
                                      const FlatObject& flat, ObjectPlace place, SparseObject& object) {
  constexpr int kRounds = 4;
  constexpr double kStill_px = 0.1;
  std::vector<SparsePoint> points = flat.points_at(place);
  std::optional<DisparityPlane> plane = surfaceOf(left, right, points, place);
  for (int round = 0; plane && round < kRounds; ++round) {
    DisparityPlane nearness = *plane;
    nearness.disparity_px += rig.doffs_px;
    const ObjectPlace next = flat.place_on(nearness);
    if (!next.found() || next.agreeing.size() < place.agreeing.size()) break;
    std::vector<SparsePoint> next_points = flat.points_at(next);
    const std::optional<DisparityPlane> next_plane = surfaceOf(left, right, next_points, next);
    if (!next_plane) break;
    const double moved_px = cv::norm(next.middle_px - place.middle_px);
    place = next;
    points = std::move(next_points);
    plane = next_plane;
    if (moved_px < kStill_px) break;
  }
  setOutline(place, object);
  if (plane)
    setMiddle(rig, *plane, place, points.size(), object);
  else
    fail(points.size(), object);
  return points;
}

double largestDisparity(const StereoCalibration& rig, const cv::Mat& view) {
  return rig.num_disparities > 0 ? rig.num_disparities : view.cols / 3.0;
}

}  // namespace pomona
