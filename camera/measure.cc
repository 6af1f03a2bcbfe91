#include "pomona/measure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/errors_alike.h"
#include "camera/region.h"
#include "camera/seen_share.h"
#include "camera/sphere_fit.h"
#include "camera/surface_fit.h"
#include "camera/triangulate.h"

namespace pomona {
namespace {

// Fruits are no spheres: what that makes of the near side and of the centre, as a share of the radius.
constexpr double kNearShapeError = 0.01, kCenterShapeError = 0.06;

// To be believed: a sphere's score, and the share that was seen of it, or of any surface.
constexpr double kLeastScore = 0.075, kLeastSeen = 0.2;
constexpr double kOnSphere_px = 1;  // so near lies what is seen of a sphere

constexpr int kSamplesToVote = 250, kSamplesToFit = 600;

void requireMap(const char* name, const cv::Mat& map, int type, cv::Size size) {
  if (!map.empty() && (map.type() != type || map.size() != size))
    throw std::invalid_argument(std::string(name) + " must be " + cv::typeToString(type) +
                                " and of the disparity map's size");
}

void requireUsable(const StereoResult& result, const StereoCalibration& calibration) {
  requireMatching(result.disparity, calibration);
  requireMap("state", result.state, CV_8UC1, result.disparity.size());
  requireMap("confidence", result.confidence, CV_32FC1, result.disparity.size());
  requireMap("sigma_px", result.sigma_px, CV_32FC1, result.disparity.size());
}

void requireValid(const MeasureOptions& options) {
  const auto require = [](bool good, const char* message) {
    if (!good) throw std::invalid_argument(message);
  };
  require(options.radius_m >= 0 && std::isfinite(options.radius_m),
          "radius_m; allowed: 0 (unknown) or a finite number above");
  require(options.radius_sigma_m >= 0 && std::isfinite(options.radius_sigma_m) &&
              (options.radius_m > 0) == (options.radius_sigma_m > 0),
          "radius_sigma_m; allowed: a finite number above 0 with a radius_m, 0 without");
  require(options.min_support_px >= 1, "min_support_px; allowed: 1 or more");
}

void setNearPoint(ObjectMeasurement& m, const cv::Vec3d& point) {
  m.near_point_m = point;
  m.distance_m = cv::norm(point);
  m.azimuth_rad = std::atan2(point[0], point[2]);
  m.elevation_rad = std::atan2(-point[1], std::hypot(point[0], point[2]));
}

// How the error that all pixels share shows at distance t along a ray: dt = t / p dp.
double commonSigma(double distance_m, double depth_m, const StereoCalibration& c) {
  return kCommonSigma_px * distance_m * depth_m / (c.focal_px * c.baseline_m);
}

void set(ObjectMeasurement& m, const FittedSphere& sphere, const StereoCalibration& calibration) {
  const double distance_m = cv::norm(sphere.center_m);
  const cv::Vec3d bearing = sphere.center_m * (1 / distance_m);
  const auto sigma = [&](double of_radius, double shape_error) {
    const cv::Vec4d gradient(bearing[0], bearing[1], bearing[2], of_radius);
    const double variance = gradient.dot(sphere.covariance * gradient);
    return std::hypot(std::sqrt(variance), commonSigma(distance_m, sphere.center_m[2], calibration),
                      shape_error * sphere.radius_m);
  };
  m.center_m = sphere.center_m;
  m.center_distance_m = distance_m;
  m.center_sigma_m = sigma(0, kCenterShapeError);
  m.radius_m = sphere.radius_m;
  m.radius_sigma_m = std::hypot(std::sqrt(sphere.covariance(3, 3)), kCenterShapeError * sphere.radius_m);
  setNearPoint(m, bearing * (distance_m - sphere.radius_m));
  m.distance_sigma_m = sigma(-1, kNearShapeError);
  m.support_px = static_cast<int>(sphere.support_px);
}

// How far the near sides of all the spheres that were tried lie from the chosen one's, by how much speaks for
// each: a leaf and the fruit behind it may both make a sphere. What is farther off than its radius is not the
// same object.
double doubtOf(const FittedSphere& chosen, const std::vector<FittedSphere>& tried) {
  const auto near = [](const FittedSphere& s) { return cv::norm(s.center_m) - s.radius_m; };
  double weights = 0, squares_m2 = 0;
  for (const FittedSphere& other : tried) {
    const double off_m = near(other) - near(chosen);
    if (std::abs(off_m) > chosen.radius_m || other.score <= 0) continue;
    const double weight = other.score * other.score;
    weights += weight;
    squares_m2 += weight * off_m * off_m;
  }
  return std::sqrt(squares_m2 / weights);
}

// By how much a sphere is larger than its region, where nothing else told its size. Something else before the
// object, taken for its middle, makes it so, and too near.
double excessOf(const FittedSphere& sphere, const Outline& outline, const StereoCalibration& c) {
  const double outline_m = outline.radius_px / c.focal_px * cv::norm(sphere.center_m);
  return std::max(0.0, sphere.radius_m - outline_m);
}

void set(ObjectMeasurement& m, const FittedSurface& surface, const StereoCalibration& calibration) {
  const double depth_m = calibration.focal_px * calibration.baseline_m / surface.parallax_px;
  setNearPoint(m, pointAt(surface.middle_px.x, surface.middle_px.y, depth_m, calibration));
  m.distance_sigma_m = m.distance_m * std::sqrt(surface.variance_px2) / surface.parallax_px;
  m.support_px = static_cast<int>(surface.support_px);
}

ObjectMeasurement failed(MeasureFailure failure) {
  ObjectMeasurement m;
  m.failure = failure;
  return m;
}

}  // namespace

std::string_view explain(MeasureFailure failure) {
  switch (failure) {
    case MeasureFailure::kNone:
      return "measured";
    case MeasureFailure::kOutside:
      return "the region holds no pixel of the image";
    case MeasureFailure::kUnmatched:
      return "hardly any pixel of the region has a disparity";
    case MeasureFailure::kInfinite:
      return "the disparities are those of infinity, or beyond";
    case MeasureFailure::kScattered:
      return "too few of the disparities agree on one surface";
    case MeasureFailure::kUnseen:
      return "most of what the region shows was not measured: it may be something that only one camera sees";
  }
  return "unknown";
}

ObjectMeasurement measureObject(const StereoResult& result, const StereoCalibration& calibration,
                                const Region& region, const MeasureOptions& options) {
  requireUsable(result, calibration);
  requireValid(options);
  const Outline outline = outlineOf(region, result.disparity.size());
  const RegionMask mask = maskOf(region, result.disparity.size());
  if (mask.pixels == 0) return failed(MeasureFailure::kOutside);
  const RegionSamples samples = samplesOf(result, calibration, outline, mask, kSamplesToFit);
  if (samples.known_px < options.min_support_px) return failed(MeasureFailure::kUnmatched);
  if (samples.known_px - samples.infinite_px < options.min_support_px)
    return failed(MeasureFailure::kInfinite);

  ObjectMeasurement m = failed(MeasureFailure::kNone);
  if (options.shape == ObjectShape::kSphere) {
    const RadiusPrior prior{options.radius_m, options.radius_sigma_m};
    const RegionSamples few = samplesOf(result, calibration, outline, mask, kSamplesToVote);
    std::vector<FittedSphere> spheres;
    for (const FittedSphere& guess : vote(few, outline, prior, calibration))
      if (const auto sphere = refine(guess, samples, outline, prior, calibration)) spheres.push_back(*sphere);
    const auto best = std::max_element(spheres.begin(), spheres.end(),
                                       [](const auto& a, const auto& b) { return a.score < b.score; });
    if (best != spheres.end() && best->score > kLeastScore) {
      const auto sphere = [&](const cv::Vec3d& ray) { return parallaxAlong(ray, *best, calibration); };
      if (seenShare(samples, calibration, sphere, kOnSphere_px) < kLeastSeen)
        return failed(MeasureFailure::kUnseen);
      set(m, *best, calibration);
      const double excess_m = prior.radius_m > 0 ? 0 : excessOf(*best, outline, calibration);
      m.distance_sigma_m = std::hypot(m.distance_sigma_m, doubtOf(*best, spheres), excess_m);
    }
  } else if (const auto surface = fitSurface(samples)) {
    const auto everywhere = [&](const cv::Vec3d&) { return std::optional(surface->parallax_px); };
    if (seenShare(samples, calibration, everywhere, kSurfaceReach_px) < kLeastSeen)
      return failed(MeasureFailure::kUnseen);
    set(m, *surface, calibration);
  }
  if (m.support_px < options.min_support_px) return failed(MeasureFailure::kScattered);
  m.support_share = std::min(1.0, static_cast<double>(m.support_px) / mask.pixels);
  return m;
}

PointMeasurement measurePoint(const StereoResult& result, const StereoCalibration& calibration, double x,
                              double y) {
  requireUsable(result, calibration);
  PointMeasurement m;
  m.failure = MeasureFailure::kOutside;
  const cv::Size size = result.disparity.size();
  if (!(x >= -0.5 && x < size.width - 0.5 && y >= -0.5 && y < size.height - 0.5)) return m;
  const int column = static_cast<int>(std::floor(x + 0.5)), row = static_cast<int>(std::floor(y + 0.5));
  m.state = result.state.empty() ? PixelState::kMeasured : result.stateAt(row, column);
  const double d = result.disparity.at<float>(row, column);
  const double depth_m = depthAt(d, calibration);
  m.failure = !std::isfinite(d)         ? MeasureFailure::kUnmatched
              : !std::isfinite(depth_m) ? MeasureFailure::kInfinite
                                        : MeasureFailure::kNone;
  if (!m.ok()) return m;
  m.point_m = pointAt(column, row, depth_m, calibration);
  m.distance_m = cv::norm(m.point_m);
  if (!result.sigma_px.empty())
    m.distance_sigma_m = m.distance_m * result.sigma_px.at<float>(row, column) / (d + calibration.doffs_px);
  return m;
}

}  // namespace pomona
