#include "datasets/rendering/solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/rendering/picture_paint.h"

namespace pomona {
namespace {

using cv::Vec3d;

Vec3d unit(const Vec3d& v) {
  return v * (1 / std::sqrt(v.dot(v)));
}

// The matrix whose product with a u + b v + c w is (a, b, c).
cv::Matx33d dualBasis(const Vec3d& u, const Vec3d& v, const Vec3d& w) {
  const double volume = u.dot(v.cross(w));
  const Vec3d a = v.cross(w) * (1 / volume), b = w.cross(u) * (1 / volume), c = u.cross(v) * (1 / volume);
  return {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
}

// Two vectors of length `length` at right angles to `axis` and to each other.
std::pair<Vec3d, Vec3d> across(const Vec3d& axis, double length) {
  const Vec3d other = std::abs(axis[0]) > std::abs(axis[1]) ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  const Vec3d first = unit(axis.cross(other));
  return {first * length, unit(axis.cross(first)) * length};
}

// A leaf's outline, |b| <= edge(a), and the largest edge there is.
double leafEdge(double a) {
  return (1 - a * a) * (1 - 0.45 * a);
}
constexpr double kWidest = 1.047;

bool isFlat(Shape shape) {
  return shape == Shape::kPlane || shape == Shape::kParallelogram || shape == Shape::kEllipse;
}

}  // namespace

Solid::Solid(const Surface& s, std::uint64_t paint_seed)
    : shape(s.shape),
      center(s.center),
      paint(s.paint),
      seed(paint_seed),
      half_length_m(std::sqrt(s.u.dot(s.u))),
      half_width_m(std::sqrt(s.v.dot(s.v))),
      reductions(s.paint.pattern == Pattern::kPicture ? reductionsOf(s.paint.picture)
                                                      : std::vector<cv::Mat>()),
      u_(s.u),
      v_(s.v),
      normal_(s.u.cross(s.v)),
      radius_m_(s.radius_m),
      bend_u_m_(s.bend_u_m),
      bend_v_m_(s.bend_v_m),
      taper_(s.taper) {
  if (shape == Shape::kSphere) {
    to_local_ = cv::Matx33d::eye() * (1 / radius_m_);
  } else if (shape == Shape::kSpheroid || shape == Shape::kBranch) {
    const auto [a, b] = across(v_, radius_m_);
    to_local_ = dualBasis(a, b, v_);
  } else {
    if (shape == Shape::kLeaf) normal_ = unit(normal_);
    to_local_ = dualBasis(u_, v_, normal_);
  }
  reach2_m2_ = reach2();
}

// Farther from the center there is nothing.
double Solid::reach2() const {
  if (shape == Shape::kLeaf) {
    const double along = half_length_m, across = kWidest * half_width_m;
    const double up = std::abs(bend_u_m_) + kWidest * kWidest * std::abs(bend_v_m_);
    return 1.001 * (along * along + across * across + up * up);
  }
  const double radius = radius_m_ * (1 + std::abs(taper_));
  return 1.001 * (half_width_m * half_width_m + radius * radius);
}

double Solid::depthAlong(const Vec3d& origin, const Vec3d& direction) const {
  if (shape == Shape::kSphere) return depthToSphere(origin, direction);
  return isFlat(shape) ? depthToPlane(origin, direction) : depthToQuadric(origin, direction);
}

double Solid::depthToSphere(const Vec3d& origin, const Vec3d& direction) const {
  const Vec3d from_center = origin - center;
  const double a = direction.dot(direction);
  const double b = direction.dot(from_center);
  const double discriminant = b * b - a * (from_center.dot(from_center) - radius_m_ * radius_m_);
  const double depth = discriminant >= 0 ? (-b - std::sqrt(discriminant)) / a : kNowhere;
  return depth > kNearest_m && depth < kFarthest_m ? depth : kNowhere;
}

double Solid::depthToPlane(const Vec3d& origin, const Vec3d& direction) const {
  const Vec3d from_center = origin - center;
  const double along_normal = normal_.dot(direction);
  const double depth = along_normal != 0 ? -normal_.dot(from_center) / along_normal : kNowhere;
  if (!(depth > kNearest_m && depth < kFarthest_m)) return kNowhere;
  return shape == Shape::kPlane || isWithin(to_local_ * (from_center + direction * depth)) ? depth : kNowhere;
}

// In the surface's own coordinates (a, b, c) each curved shape is the zero of a quadratic form, so that a ray
// o + t d meets it where A t^2 + 2 B t + C = 0.
double Solid::depthToQuadric(const Vec3d& origin, const Vec3d& direction) const {
  const Vec3d from_center = origin - center;
  const double along = from_center.dot(direction);
  if (along * along < (from_center.dot(from_center) - reach2_m2_) * direction.dot(direction)) return kNowhere;
  const Vec3d o = to_local_ * from_center, d = to_local_ * direction;
  double a, b, c;
  if (shape == Shape::kSpheroid) {  // a^2 + b^2 + c^2 = 1
    a = d.dot(d);
    b = o.dot(d);
    c = o.dot(o) - 1;
  } else if (shape == Shape::kBranch) {  // a^2 + b^2 = (1 - taper c)^2
    const double radius = 1 - taper_ * o[2], growth = -taper_ * d[2];
    a = d[0] * d[0] + d[1] * d[1] - growth * growth;
    b = o[0] * d[0] + o[1] * d[1] - radius * growth;
    c = o[0] * o[0] + o[1] * o[1] - radius * radius;
  } else {  // c = bend_u a^2 + bend_v b^2
    a = bend_u_m_ * d[0] * d[0] + bend_v_m_ * d[1] * d[1];
    b = bend_u_m_ * o[0] * d[0] + bend_v_m_ * o[1] * d[1] - 0.5 * d[2];
    c = bend_u_m_ * o[0] * o[0] + bend_v_m_ * o[1] * o[1] - o[2];
  }
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return kNowhere;
  // -B with its root added to its magnitude loses no digits; the other solution follows from C / A.
  const double sum = b > 0 ? -b - std::sqrt(discriminant) : -b + std::sqrt(discriminant);
  double depths[] = {sum / a, c / sum};
  if (depths[1] < depths[0]) std::swap(depths[0], depths[1]);
  for (const double depth : depths)
    if (depth > kNearest_m && depth < kFarthest_m && isWithin(o + d * depth)) return depth;
  return kNowhere;
}

bool Solid::isWithin(const Vec3d& p) const {
  switch (shape) {
    case Shape::kParallelogram:
      return std::abs(p[0]) <= 1 && std::abs(p[1]) <= 1;
    case Shape::kEllipse:
      return p[0] * p[0] + p[1] * p[1] <= 1;
    case Shape::kBranch:
      return std::abs(p[2]) <= 1;
    case Shape::kLeaf:
      return std::abs(p[0]) <= 1 && std::abs(p[1]) <= leafEdge(p[0]);
    default:
      return true;
  }
}

Bounds Solid::bounds() const {
  Vec3d half;
  for (int i = 0; i < 3; ++i) switch (shape) {
      case Shape::kPlane:
        half[i] = kFarthest_m;
        break;
      case Shape::kSphere:
        half[i] = radius_m_;
        break;
      case Shape::kSpheroid: {
        const double axis = v_[i] / half_width_m;
        half[i] = std::sqrt(v_[i] * v_[i] + radius_m_ * radius_m_ * std::max(0.0, 1 - axis * axis));
        break;
      }
      case Shape::kBranch:
        half[i] = std::abs(v_[i]) + radius_m_ * (1 + std::abs(taper_));
        break;
      case Shape::kLeaf:
        half[i] = std::abs(u_[i]) + kWidest * std::abs(v_[i]) +
                  std::abs(normal_[i]) * (std::abs(bend_u_m_) + kWidest * kWidest * std::abs(bend_v_m_));
        break;
      default:
        half[i] = std::abs(u_[i]) + std::abs(v_[i]);
    }
  return {center - half, center + half};
}

Vec3d Solid::normalAt(const Vec3d& point) const {
  const Vec3d p = localAt(point);
  Vec3d gradient(0, 0, 1);
  if (shape == Shape::kSphere || shape == Shape::kSpheroid) gradient = p;
  if (shape == Shape::kBranch) gradient = {p[0], p[1], taper_ * (1 - taper_ * p[2])};
  if (shape == Shape::kLeaf) gradient = {-2 * bend_u_m_ * p[0], -2 * bend_v_m_ * p[1], 1};
  return unit(to_local_.t() * gradient);
}

}  // namespace pomona
