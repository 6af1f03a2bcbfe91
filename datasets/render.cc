#include "datasets/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "datasets/hash.h"

namespace pomona {
namespace {

using cv::Vec3d;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kNearest_m = 1e-6;

// A surface with everything that does not depend on the ray worked out.
struct Solid {
  Shape shape;
  Vec3d center, normal;
  Vec3d dual_u, dual_v;  // (P - center) . dual_u is the coordinate a of P = center + a u + b v
  double radius_m;
  Paint paint;
  std::uint64_t seed;

  Solid(const Surface& s, std::uint64_t paint_seed)
      : shape(s.shape),
        center(s.center),
        normal(s.u.cross(s.v)),
        radius_m(s.radius_m),
        paint(s.paint),
        seed(paint_seed) {
    const double area2 = normal.dot(normal);
    if (shape == Shape::kSphere || area2 == 0) return;
    dual_u = s.v.cross(normal) * (1 / area2);
    dual_v = normal.cross(s.u) * (1 / area2);
  }

  // Depth Z at which the ray origin + Z * direction (direction.z = 1) meets this surface first.
  double depthAlong(const Vec3d& origin, const Vec3d& direction) const {
    const Vec3d from_center = origin - center;
    if (shape == Shape::kSphere) {
      const double a = direction.dot(direction);
      const double b = direction.dot(from_center);
      const double discriminant = b * b - a * (from_center.dot(from_center) - radius_m * radius_m);
      const double depth = discriminant >= 0 ? (-b - std::sqrt(discriminant)) / a : kNowhere;
      return depth > kNearest_m ? depth : kNowhere;
    }
    const double along_normal = normal.dot(direction);
    const double depth = along_normal != 0 ? -normal.dot(from_center) / along_normal : kNowhere;
    if (!(depth > kNearest_m)) return kNowhere;
    if (shape == Shape::kPlane) return depth;
    const Vec3d p = from_center + direction * depth;
    return std::abs(p.dot(dual_u)) <= 1 && std::abs(p.dot(dual_v)) <= 1 ? depth : kNowhere;
  }

  // Lambert's law with a light above and behind the cameras' left shoulder; on spheres only, for their
  // roundness.
  double shade(const Vec3d& point) const {
    if (shape != Shape::kSphere) return 1;
    const Vec3d towards_light(-0.48, -0.6, -0.64);
    return 0.45 + 0.55 * std::max(0.0, (point - center).dot(towards_light) / radius_m);
  }

  Vec3d colorAt(const Vec3d& point) const;
};

// Random values on the integer lattice, blended by 3t^2 - 2t^3 along each axis.
double valueNoise(const Vec3d& p, std::uint64_t seed) {
  std::array<std::array<std::uint64_t, 2>, 3> corner;
  std::array<double, 3> t;
  constexpr std::array<std::uint64_t, 3> kStep = {0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu,
                                                  0x165667b19e3779f9u};
  for (int axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(p[axis]);
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(floor));
    corner[axis] = {cell * kStep[axis], (cell + 1) * kStep[axis]};
    const double f = p[axis] - floor;
    t[axis] = f * f * (3 - 2 * f);
  }
  const auto alongX = [&](int y, int z) {
    const std::uint64_t base = seed + corner[1][y] + corner[2][z];
    const double a = unitInterval(hash(base + corner[0][0])), b = unitInterval(hash(base + corner[0][1]));
    return a + t[0] * (b - a);
  };
  const auto alongY = [&](int z) { return alongX(0, z) + t[1] * (alongX(1, z) - alongX(0, z)); };
  return alongY(0) + t[2] * (alongY(1) - alongY(0));
}

Vec3d Solid::colorAt(const Vec3d& point) const {
  constexpr int kOctaves = 3;
  constexpr double kGain = 0.8;  // each octave's amplitude relative to the one before: rich in fine detail
  Vec3d p = (point - center) * (1 / paint.cell_m);
  double sum = 0, weight = 1, total = 0;
  for (int octave = 0; octave < kOctaves; ++octave, weight *= kGain, p *= 2) {
    sum += weight * (valueNoise(p, seed + octave) - 0.5);
    total += weight;
  }
  const double mix =
      std::clamp(0.5 + 1.8 * sum / total, 0.0, 1.0);  // the sum of octaves seldom leaves +-0.28
  return (paint.first_bgr + (paint.second_bgr - paint.first_bgr) * mix) * shade(point);
}

struct Hit {
  const Solid* solid = nullptr;
  double depth = kNowhere;
};

class Renderer {
 public:
  explicit Renderer(const SceneDescription& scene)
      : scene_(scene),
        cx_((scene.width - 1) / 2.0),
        cy_((scene.height - 1) / 2.0),
        solids_of_row_(scene.height) {
    solids_.reserve(scene.surfaces.size());
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
      solids_.emplace_back(scene.surfaces[i], hash(scene.seed * 0x2545f4914f6cdd1du + i));
    for (std::size_t i = 0; i < solids_.size(); ++i) addToRows(solids_[i], scene.surfaces[i]);
  }

  RenderedView view(bool right) const {
    const cv::Size size(scene_.width, scene_.height);
    RenderedView view{cv::Mat(size, CV_MAKETYPE(scene_.bits == 8 ? CV_8U : CV_16U, scene_.channels)),
                      cv::Mat(size, CV_32FC1), cv::Mat(size, CV_8UC1)};
    parallelStrips(availableThreads(), scene_.height, 4, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < scene_.width; ++x) {
          storeColor(meanColor(x, y, right), view.image, y, x);
          storeGeometry(right, view, y, x);
        }
    });
    return view;
  }

 private:
  Vec3d origin(bool right) const { return {right ? scene_.baseline_m : 0, 0, 0}; }
  Vec3d direction(double x, double y) const {
    return {(x - cx_) / scene_.focal_px, (y - cy_) / scene_.focal_px, 1};
  }

  // Both cameras see a point in the same row, so each row has to look only at the surfaces that can reach it:
  // those whose bounding sphere's bounding box, seen in perspective, does.
  void addToRows(const Solid& solid, const Surface& s) {
    const double radius =
        s.shape == Shape::kSphere ? s.radius_m : std::sqrt(s.u.dot(s.u)) + std::sqrt(s.v.dot(s.v));
    const double near = solid.center[2] - radius, far = solid.center[2] + radius;
    double top = 0, bottom = scene_.height - 1;
    if (s.shape != Shape::kPlane && near > kNearest_m) {
      const double highest = solid.center[1] - radius, lowest = solid.center[1] + radius;
      const auto row = [&](double height, double depth) { return cy_ + scene_.focal_px * height / depth; };
      top = std::max(top, std::floor(std::min(row(highest, near), row(highest, far))) - 1);
      bottom = std::min(bottom, std::ceil(std::max(row(lowest, near), row(lowest, far))) + 1);
    }
    for (int y = static_cast<int>(top); y <= bottom; ++y) solids_of_row_[y].push_back(&solid);
  }

  Hit firstHit(int row, const Vec3d& from, const Vec3d& along) const {
    Hit hit;
    for (const Solid* solid : solids_of_row_[row])
      if (const double depth = solid->depthAlong(from, along); depth < hit.depth) hit = {solid, depth};
    return hit;
  }

  Vec3d meanColor(int x, int y, bool right) const {
    constexpr int kSide = 4;
    Vec3d sum(0, 0, 0);
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const Vec3d along = direction(x + (i + 0.5) / kSide - 0.5, y + (j + 0.5) / kSide - 0.5);
        const Hit hit = firstHit(y, origin(right), along);
        if (hit.solid) sum += hit.solid->colorAt(origin(right) + along * hit.depth);
      }
    return sum * (1.0 / (kSide * kSide));
  }

  void storeColor(const Vec3d& bgr, cv::Mat& image, int y, int x) const {
    const double gray = 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2];
    for (int c = 0; c < scene_.channels; ++c) {
      const double value = std::clamp(scene_.channels == 1 ? gray : bgr[c], 0.0, 255.0);
      if (scene_.bits == 8)
        image.ptr<std::uint8_t>(y)[x * scene_.channels + c] = static_cast<std::uint8_t>(value + 0.5);
      else
        image.ptr<std::uint16_t>(y)[x * scene_.channels + c] = static_cast<std::uint16_t>(value * 257 + 0.5);
    }
  }

  void storeGeometry(bool right, RenderedView& view, int y, int x) const {
    constexpr std::uint8_t kNothing = 0, kOccluded = 128, kVisible = 255;
    const Vec3d along = direction(x, y);
    const Hit hit = firstHit(y, origin(right), along);
    if (!hit.solid) {
      view.disparity.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
      view.mask.at<std::uint8_t>(y, x) = kNothing;
      return;
    }
    const double disparity = scene_.focal_px * scene_.baseline_m / hit.depth;
    const double other_x = right ? x + disparity : x - disparity;
    const double blocked = firstHit(y, origin(!right), direction(other_x, y)).depth;
    const bool inside = other_x >= -0.5 && other_x < scene_.width - 0.5;
    const bool visible = inside && blocked >= hit.depth * (1 - 1e-9);
    view.disparity.at<float>(y, x) = static_cast<float>(disparity);
    view.mask.at<std::uint8_t>(y, x) = visible ? kVisible : kOccluded;
  }

  const SceneDescription& scene_;
  double cx_, cy_;
  std::vector<Solid> solids_;
  std::vector<std::vector<const Solid*>> solids_of_row_;
};

void require(bool good, const std::string& message) {
  if (!good) throw std::invalid_argument("scene: " + message);
}

void validate(const SceneDescription& scene) {
  constexpr int kLargestSide = 1 << 15;
  const auto side = [&](const char* name, int value) {
    require(value >= 1 && value <= kLargestSide, std::string(name) + " is " + std::to_string(value) +
                                                     "; allowed: 1 to " + std::to_string(kLargestSide));
  };
  side("width", scene.width);
  side("height", scene.height);
  require(scene.channels == 1 || scene.channels == 3,
          "channels is " + std::to_string(scene.channels) + "; allowed: 1 or 3");
  require(scene.bits == 8 || scene.bits == 16,
          "bits is " + std::to_string(scene.bits) + "; allowed: 8 or 16");
  for (const Surface& s : scene.surfaces) {
    const Vec3d normal = s.u.cross(s.v);
    require(s.shape == Shape::kSphere ? s.radius_m > 0 : normal.dot(normal) > 0,
            "a surface without extent: a sphere needs a radius_m > 0, other shapes u and v that are not "
            "parallel");
    require(s.paint.cell_m > 0, "paint.cell_m must be positive");
  }
}

}  // namespace

RenderedPair render(const SceneDescription& scene) {
  validate(scene);
  StereoCalibration calibration;
  calibration.focal_px = scene.focal_px;
  calibration.cx_px = (scene.width - 1) / 2.0;
  calibration.cy_px = (scene.height - 1) / 2.0;
  calibration.baseline_m = scene.baseline_m;
  calibration.width = scene.width;
  calibration.height = scene.height;
  calibration.num_disparities = scene.num_disparities;
  calibration.validate();
  const Renderer renderer(scene);
  return {renderer.view(false), renderer.view(true), calibration};
}

}  // namespace pomona
