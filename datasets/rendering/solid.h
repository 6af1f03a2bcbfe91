// A surface of a scene, prepared to be met by rays.
#pragma once

#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "datasets/render.h"

namespace pomona {

/// Depths of a ray outside of these bounds meet nothing.
constexpr double kNearest_m = 1e-6, kFarthest_m = 1e6;
constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// Ranges of the coordinates.
struct Bounds {
  cv::Vec3d low, high;
};

class Solid {
 public:
  Solid(const Surface& surface, std::uint64_t paint_seed);

  /// The smallest t at which origin + t * direction lies on the surface; the depth Z if direction.z = 1.
  /// kNowhere if there is none.
  double depthAlong(const cv::Vec3d& origin, const cv::Vec3d& direction) const;
  /// Contains all of the surface; infinite for planes.
  Bounds bounds() const;
  /// Of length 1; either side.
  cv::Vec3d normalAt(const cv::Vec3d& point) const;
  /// (a, b, c) of `point` on the surface: what the shape's equation calls a and b, for kLeaf and kEllipse
  /// too; of round shapes c runs along v, -1 at its tail and 1 at its head, and a and b are coordinates at
  /// right angles to it in units of radius_m; kSphere: along X, Y, Z.
  cv::Vec3d localAt(const cv::Vec3d& point) const { return to_local_ * (point - center); }

  Shape shape;
  cv::Vec3d center;
  Paint paint;
  std::uint64_t seed;
  double half_length_m, half_width_m;  ///< lengths of u and v
  std::vector<cv::Mat> reductions;  ///< kPicture: paint.picture, and each reduced by two from the one before
  double radiusM() const { return radius_m_; }

 private:
  double depthToSphere(const cv::Vec3d& origin, const cv::Vec3d& direction) const;
  double depthToPlane(const cv::Vec3d& origin, const cv::Vec3d& direction) const;
  double depthToQuadric(const cv::Vec3d& origin, const cv::Vec3d& direction) const;
  bool isWithin(const cv::Vec3d& local) const;
  double reach2() const;

  cv::Vec3d u_, v_, normal_;
  double radius_m_, bend_u_m_, bend_v_m_, taper_;
  cv::Matx33d to_local_;
  double reach2_m2_;  ///< of the curved shapes: no place on them is farther from the center, squared
};

}  // namespace pomona
