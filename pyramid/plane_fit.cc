#include "pyramid/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pomona {
namespace {

constexpr int kMaxSamples = 400;
constexpr double kMissProbability = 0.01;  // that no sample so far consisted of inliers only
constexpr float kMinDeterminant_px2 = 4;   // twice the area of a sample's triangle
constexpr int kRefinements = 2;
// Added to the variances, so that points along a line get a plane that is level across it.
constexpr double kRidge_px2 = 0.1;

// D. E. Knuth's MMIX generator; the upper bits are the good ones.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) { next(1); }
  int next(int end) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<int>((state_ >> 32) * static_cast<std::uint64_t>(end) >> 32);
  }

 private:
  std::uint64_t state_;
};

int countInliers(const DisparityPlane& q, const PlanePoints& p, const PyramidKernels& kernels) {
  return kernels.countNearPlane(p.x, p.y, p.d, p.count, q.a, q.b, q.c, kPlaneTolerance_px);
}

bool isTooSteep(double a, double b) {
  return !(std::abs(a) <= kMaxPlaneSlope && std::abs(b) <= kMaxPlaneSlope);
}

std::optional<DisparityPlane> planeThrough(const PlanePoints& p, int i, int j, int k) {
  const float x1 = p.x[j] - p.x[i], y1 = p.y[j] - p.y[i], d1 = p.d[j] - p.d[i];
  const float x2 = p.x[k] - p.x[i], y2 = p.y[k] - p.y[i], d2 = p.d[k] - p.d[i];
  const float determinant = x1 * y2 - x2 * y1;
  if (!(std::abs(determinant) >= kMinDeterminant_px2)) return {};
  const float a = (d1 * y2 - d2 * y1) / determinant, b = (x1 * d2 - x2 * d1) / determinant;
  if (isTooSteep(a, b)) return {};
  return DisparityPlane{a, b, p.d[i] - (a * p.x[i] + b * p.y[i])};
}

// So many samples make it improbable that each of them held an outlier.
int samplesNeeded(double inlier_ratio) {
  const double spoilt = 1 - inlier_ratio * inlier_ratio * inlier_ratio;
  int samples = 0;
  for (double miss = 1; miss > kMissProbability && samples < kMaxSamples; ++samples) miss *= spoilt;
  return samples;
}

PlaneFit bestSample(const PlanePoints& p, std::uint32_t seed, const PyramidKernels& kernels) {
  Random random(seed);
  PlaneFit best{};
  int needed = kMaxSamples;
  for (int sample = 0; sample < needed; ++sample) {
    const int i = random.next(p.count), j = random.next(p.count), k = random.next(p.count);
    const std::optional<DisparityPlane> plane = planeThrough(p, i, j, k);
    if (!plane) continue;
    const int inliers = countInliers(*plane, p, kernels);
    if (inliers <= best.inliers) continue;
    best = {*plane, inliers, 0, 0};
    needed = samplesNeeded(static_cast<double>(inliers) / p.count);
  }
  return best;
}

// Least squares over the inliers of `plane`, centred.
DisparityPlane refined(const DisparityPlane& plane, const PlanePoints& p) {
  double n = 0, x = 0, y = 0, d = 0, xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (int i = 0; i < p.count; ++i) {
    if (!(std::abs(plane.at(p.x[i], p.y[i]) - p.d[i]) < kPlaneTolerance_px)) continue;
    const double xi = p.x[i], yi = p.y[i], di = p.d[i];
    n += 1;
    x += xi, y += yi, d += di;
    xx += xi * xi, xy += xi * yi, yy += yi * yi;
    xd += xi * di, yd += yi * di;
  }
  if (n == 0) return plane;
  x /= n, y /= n, d /= n;
  xx = xx / n - x * x + kRidge_px2, yy = yy / n - y * y + kRidge_px2, xy = xy / n - x * y;
  xd = xd / n - x * d, yd = yd / n - y * d;
  const double determinant = xx * yy - xy * xy;
  const double a = (xd * yy - yd * xy) / determinant, b = (yd * xx - xd * xy) / determinant;
  if (isTooSteep(a, b)) return plane;
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(d - a * x - b * y)};
}

}  // namespace

PlaneFit fitPlane(const PlanePoints& points, std::uint32_t seed, const PyramidKernels& kernels) {
  PlaneFit fit = bestSample(points, seed, kernels);
  if (fit.inliers == 0) return fit;
  for (int i = 0; i < kRefinements; ++i) fit.plane = refined(fit.plane, points);
  fit.inliers = countInliers(fit.plane, points, kernels);
  fit.low = std::numeric_limits<float>::infinity();
  fit.high = -fit.low;
  for (int i = 0; i < points.count; ++i) {
    if (!(std::abs(fit.plane.at(points.x[i], points.y[i]) - points.d[i]) < kPlaneTolerance_px)) continue;
    fit.low = std::min(fit.low, points.d[i]);
    fit.high = std::max(fit.high, points.d[i]);
  }
  return fit;
}

}  // namespace pomona
