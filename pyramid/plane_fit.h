// The plane d = a x + b y + c that most of a set of measured disparities lie near.
#pragma once

#include <algorithm>
#include <cstdint>

#include "pyramid/kernels.h"

namespace pomona {

struct DisparityPlane {
  float a, b, c;  ///< pixels per pixel, pixels per pixel, pixels
  float at(float x, float y) const { return a * x + b * y + c; }
};

/// Up to kCapacity points (x, y, d), pixels. Coordinates should be small: take an origin nearby.
struct PlanePoints {
  static constexpr int kCapacity = 512;
  int count = 0;
  float x[kCapacity], y[kCapacity], d[kCapacity];

  void add(float px, float py, float disparity) {
    x[count] = px;
    y[count] = py;
    d[count++] = disparity;
  }
};

constexpr float kPlaneTolerance_px = 1.0f;

struct PlaneFit {
  DisparityPlane plane;
  int inliers;      ///< points less than kPlaneTolerance_px away from the plane; 0 if there is no plane
  float low, high;  ///< their smallest and largest disparity

  /// Beyond what supports it a plane soon leaves the surface: from there on it is taken to be level.
  float at(float x, float y) const {
    return std::clamp(plane.at(x, y), low - kPlaneTolerance_px, high + kPlaneTolerance_px);
  }
};

constexpr float kMaxPlaneSlope = 0.6f;  ///< of |a| and |b|; steeper surfaces show themselves to one view only

/// RANSAC (M. A. Fischler and R. C. Bolles, "Random sample consensus", Comm. ACM 24(6), 1981): of planes
/// through three random points, the one with most inliers; then two rounds of least squares over its inliers.
/// The generator is seeded with `seed`: equal input gives equal bytes. No plane (0 inliers) if no sample
/// spans one within the slope limit.
PlaneFit fitPlane(const PlanePoints& points, std::uint32_t seed, const PyramidKernels& kernels);

}  // namespace pomona
