#include "camera/sphere_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "camera/errors_alike.h"
#include "camera/votes.h"

namespace pomona {
namespace {

struct Hypothesis {
  double x_px, y_px, radius_px;
};

struct Candidate {
  Hypothesis hypothesis;
  double parallax_px = 0;  // of the centre, along its bearing
  double score = 0;
};

// How hypotheses fare with the samples.
class SphereVotes {
 public:
  SphereVotes(const RegionSamples& region, const RadiusPrior& prior, const StereoCalibration& calibration)
      : samples_(region.samples), prior_(prior), calibration_(calibration), votes_(largestParallax(region)) {}

  /// Each sample votes for the parallax that the sphere's centre has if the sample lies on it.
  void cast(const Hypothesis& h) {
    const cv::Vec3d bearing = bearingOf(h);
    const double cos_alpha = std::cos(h.radius_px / calibration_.focal_px);
    const double cos_alpha2 = cos_alpha * cos_alpha;
    votes_.clear();
    for (const SurfaceSample& s : samples_) {
      const double c = s.ray.dot(bearing);
      if (c <= cos_alpha) continue;
      votes_.add(s.parallax_px * s.ray[2] * cos_alpha2 / (c + std::sqrt(c * c - cos_alpha2)),
                 s.central_trust);
    }
  }

  /// What most of the last cast's votes agree on, other than on `parallax_px`.
  Candidate candidate(const Hypothesis& h, double parallax_px = -10) const {
    const Votes::Peak peak = votes_.peak(parallax_px);
    return {h, peak.position, peak.weight * plausibility(h, peak.position)};
  }

  FittedSphere sphereOf(const Candidate& candidate) const {
    const double distance_m = calibration_.focal_px * calibration_.baseline_m / candidate.parallax_px;
    FittedSphere sphere;
    sphere.center_m = bearingOf(candidate.hypothesis) * distance_m;
    sphere.radius_m = distance_m * std::sin(candidate.hypothesis.radius_px / calibration_.focal_px);
    return sphere;
  }

 private:
  cv::Vec3d bearingOf(const Hypothesis& h) const {
    const cv::Vec3d direction((h.x_px - calibration_.cx_px) / calibration_.focal_px,
                              (h.y_px - calibration_.cy_px) / calibration_.focal_px, 1);
    return direction * (1 / cv::norm(direction));
  }

  // By the radius that it would have, if one is expected; hypotheses are not closer than a seventh.
  double plausibility(const Hypothesis& h, double parallax_px) const {
    if (prior_.radius_m <= 0 || parallax_px <= 0) return 1;
    const double radius_m = calibration_.baseline_m * calibration_.focal_px / parallax_px *
                            std::sin(h.radius_px / calibration_.focal_px);
    const double off = (radius_m - prior_.radius_m) / std::hypot(prior_.sigma_m, prior_.radius_m / 7);
    return std::exp(-0.5 * off * off);
  }

  const std::vector<SurfaceSample>& samples_;
  const RadiusPrior& prior_;
  const StereoCalibration& calibration_;
  Votes votes_;
};

// What is seen through a sphere speaks more clearly against it than what lies on it does for it, which may be
// something flat before the object.
constexpr double kSeenThrough = 2;

// The radius that the outline tells of, where nothing else does: an object may fill it, or half of it, or be
// cut off by it. Standard deviation as a share of the radius.
constexpr double kRoughly = 0.3;

double centralTrust(const RegionSamples& region) {
  double sum = 0;
  for (const SurfaceSample& s : region.samples) sum += s.central_trust;
  return sum;
}

// One pass of Gauss-Newton.
struct NormalEquations {
  cv::Matx44d information = cv::Matx44d::zeros();  // its upper half, until makeSymmetric()
  cv::Vec4d gradient = cv::Vec4d::all(0);
  double squares = 0, trust = 0, pixels = 0;   // of the samples on the sphere
  double central_trust = 0, seen_through = 0;  // of those, and of those behind it

  /// A row that is (scale normal, scale).
  void add(const cv::Vec3d& normal, double scale, double residual, double weight) {
    const double row[4] = {scale * normal[0], scale * normal[1], scale * normal[2], scale};
    for (int i = 0; i < 4; ++i) {
      const double weighted = weight * row[i];
      for (int j = i; j < 4; ++j) information(i, j) += weighted * row[j];
      gradient[i] += weighted * residual;
    }
  }
  void makeSymmetric() {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) information(i, j) = information(j, i);
  }
};

// How far samples may be off, as shares of the reach.
struct Reach {
  double before, behind;
};

NormalEquations normalEquations(const FittedSphere& sphere, const RegionSamples& region,
                                const StereoCalibration& calibration, const Reach& reach) {
  constexpr double kSteepest = 0.45;  // cosine of the slant against the line of sight
  // A leaf lies 1 or 2 cm before its fruit: far away, that is less than a pixel, and no outlier to a wider
  // reach.
  constexpr double kReach_sigmas = 2, kMostReach_px = 1;
  constexpr double kShapeError = 0.02;   // of the radius: no fruit is a sphere
  constexpr double kLargestDent = 0.15;  // of the radius: what is farther behind is seen through it
  const double focal_baseline = calibration.focal_px * calibration.baseline_m;
  const double independent = region.pixels_each / kAlike_px;
  const double squared_radius = sphere.radius_m * sphere.radius_m;
  const double beyond = sphere.center_m.dot(sphere.center_m) - squared_radius;
  NormalEquations equations;
  for (const SurfaceSample& s : region.samples) {
    const double along = s.ray.dot(sphere.center_m);
    const double inside = along * along - beyond;
    if (inside < kSteepest * kSteepest * squared_radius) continue;
    const double depth_in_sphere = std::sqrt(inside);  // half of the chord
    const double t = along - depth_in_sphere;
    const double parallax_px = focal_baseline / (t * s.ray[2]);
    const double residual = s.parallax_px - parallax_px;
    const double sigma_px = std::max(s.sigma_px, kSmallestSigma_px);
    const double radius_px = sphere.radius_m * parallax_px / t;  // by how much a radius nearer is more
    const double shape_px = kShapeError * radius_px;
    const double reach_px2 =
        std::min(kReach_sigmas * kReach_sigmas * (sigma_px * sigma_px + shape_px * shape_px),
                 kMostReach_px * kMostReach_px);
    const double share = residual > 0 ? reach.before : reach.behind;
    const double off_px2 = residual * residual;
    if (s.measured && off_px2 >= reach_px2 && -residual > kLargestDent * radius_px)
      equations.seen_through += s.central_trust;
    if (off_px2 >= share * share * reach_px2) continue;
    const double u2 = off_px2 / (share * share * reach_px2), biweight = (1 - u2) * (1 - u2);
    const double weight = s.trust * biweight / (sigma_px * sigma_px);
    const cv::Vec3d normal = (s.ray * t - sphere.center_m) * (1 / sphere.radius_m);
    const double scale = radius_px / depth_in_sphere;  // -dp/dt / -(r n)
    equations.add(normal, scale, residual, weight * independent);
    equations.squares += weight * off_px2;
    equations.trust += s.trust * biweight;
    equations.central_trust += s.central_trust * biweight;
    equations.pixels += region.pixels_each;
  }
  equations.makeSymmetric();
  return equations;
}

}  // namespace

std::optional<double> parallaxAlong(const cv::Vec3d& ray, const FittedSphere& sphere,
                                    const StereoCalibration& calibration) {
  const double along = ray.dot(sphere.center_m);
  const double inside =
      along * along - sphere.center_m.dot(sphere.center_m) + sphere.radius_m * sphere.radius_m;
  if (inside <= 0) return {};
  const double depth_m = (along - std::sqrt(inside)) * ray[2];
  if (depth_m <= 0) return {};
  return calibration.focal_px * calibration.baseline_m / depth_m;
}

std::vector<FittedSphere> vote(const RegionSamples& region, const Outline& outline, const RadiusPrior& prior,
                               const StereoCalibration& calibration) {
  constexpr double kStep = 0.3, kRatio = 1.33;  // of the outline's radius; between radii
  constexpr std::size_t kMostGuesses = 8;
  SphereVotes votes(region, prior, calibration);
  std::vector<Candidate> coarse;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      for (int power = -2; power <= 1; ++power) {
        const Hypothesis h{outline.center_px.x + dx * kStep * outline.radius_px,
                           outline.center_px.y + dy * kStep * outline.radius_px,
                           outline.radius_px * std::pow(kRatio, power)};
        votes.cast(h);
        coarse.push_back(votes.candidate(h));
        coarse.push_back(votes.candidate(h, coarse.back().parallax_px));
      }
  std::stable_sort(coarse.begin(), coarse.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });

  std::vector<Candidate> best;
  for (const Candidate& c : coarse) {
    const auto same = [&](const Candidate& b) {
      return std::abs(b.parallax_px - c.parallax_px) < Votes::kApart_px;
    };
    if (c.score > 0 && best.size() < kMostGuesses && std::none_of(best.begin(), best.end(), same))
      best.push_back(c);
  }
  std::vector<FittedSphere> spheres;
  for (const Candidate& c : best) spheres.push_back(votes.sphereOf(c));
  return spheres;
}

std::optional<FittedSphere> refine(const FittedSphere& guess, const RegionSamples& region,
                                   const Outline& outline, const RadiusPrior& prior,
                                   const StereoCalibration& calibration) {
  // Nothing is seen through a fruit: so what is off to the near side is another thing sooner than what is off
  // to the far side, until the sphere is found. Then an uneven reach would only draw it away.
  constexpr Reach kUneven{0.5, 1}, kEven{0.5, 0.5};
  constexpr int kRounds = 7, kUnevenRounds = 5;
  constexpr double kSmallest = 0.4, kLargest = 1.4, kSigmas = 3;  // of the outline's radius; of the prior's
  FittedSphere sphere = guess;
  for (int round = 0;; ++round) {
    const Reach& reach = round < kUnevenRounds ? kUneven : kEven;
    NormalEquations equations = normalEquations(sphere, region, calibration, reach);
    const double distance_m = cv::norm(sphere.center_m);
    const double outline_m = outline.radius_px / calibration.focal_px * distance_m;
    const RadiusPrior radius = prior.radius_m > 0 ? prior : RadiusPrior{outline_m, kRoughly * outline_m};
    const double certainty = 1 / (radius.sigma_m * radius.sigma_m);
    equations.information(3, 3) += certainty;
    equations.gradient[3] += certainty * (radius.radius_m - sphere.radius_m);
    // Little is seen of some: then all that is known of their sides is that they are in the outline.
    for (int axis = 0; axis < 2; ++axis) equations.information(axis, axis) += 1 / (outline_m * outline_m);
    bool solved = false;
    const cv::Matx44d covariance = equations.information.inv(cv::DECOMP_CHOLESKY, &solved);
    if (!solved || equations.pixels == 0) return {};
    if (round == kRounds) {
      sphere.covariance = covariance * std::max(1.0, equations.squares / equations.trust);
      sphere.support_px = equations.pixels;
      const double off = (sphere.radius_m - radius.radius_m) / radius.sigma_m;
      sphere.score = (equations.central_trust - kSeenThrough * equations.seen_through) /
                     centralTrust(region) / (1 + 0.5 * off * off);
      return sphere;
    }
    cv::Vec4d step = covariance * equations.gradient;
    const double longest = std::sqrt(step.dot(step)), limit = 0.5 * sphere.radius_m;
    if (longest > limit) step *= limit / longest;
    for (int axis = 0; axis < 3; ++axis) sphere.center_m[axis] += step[axis];
    const double smallest_m =
        prior.radius_m > 0 ? prior.radius_m - kSigmas * prior.sigma_m : kSmallest * outline_m;
    const double largest_m =
        prior.radius_m > 0 ? prior.radius_m + kSigmas * prior.sigma_m : kLargest * outline_m;
    sphere.radius_m = std::clamp(sphere.radius_m + step[3], smallest_m, largest_m);
    if (sphere.radius_m <= 0) return {};
    if (!(sphere.center_m[2] > sphere.radius_m)) return {};
  }
}

}  // namespace pomona
