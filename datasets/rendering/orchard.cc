#include "datasets/rendering/orchard.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "datasets/hash.h"
#include "datasets/rendering/nearest_surface.h"
#include "datasets/rendering/solid.h"

namespace pomona {
namespace {

using cv::Vec3d;

struct Colors {
  Vec3d first_bgr, second_bgr;
};
const Colors kSky{{205, 165, 120}, {235, 215, 190}};
const Colors kMeadow{{25, 75, 60}, {70, 160, 125}};
const Colors kHedge{{25, 50, 30}, {60, 110, 75}};
const Colors kBark{{35, 50, 65}, {105, 130, 150}};
const Colors kTwig{{40, 70, 80}, {80, 120, 125}};
const Colors kLeaves[] = {
    {{20, 75, 40}, {60, 160, 100}}, {{15, 60, 30}, {50, 135, 75}}, {{30, 90, 70}, {75, 175, 140}}};
const Colors kRed{{65, 150, 185}, {35, 28, 150}};
const Colors kGolden{{70, 170, 165}, {60, 160, 215}};

constexpr double kCameraHeight_m = 1.25;
constexpr double kLargestRadius_m = 0.042;

Vec3d unit(const Vec3d& v) {
  return v * (1 / std::sqrt(v.dot(v)));
}

// Braced lists are evaluated from left to right, so that every compiler draws the random numbers in the same
// order; function arguments would not be.
class OrchardBuilder {
 public:
  OrchardBuilder(const SceneDescription& cameras, const OrchardOptions& options)
      : options_(options),
        random_(hash(options.seed) ^ 0x6f7263686172u),
        middle_m_((options.nearest_m + options.farthest_m) / 2) {
    orchard_.scene = cameras;
    orchard_.scene.seed = options.seed;
    orchard_.scene.sun = true;
    constexpr double kHorizon_m = 60;
    const double product = cameras.focal_px * cameras.baseline_m;  // beyond product / doffs, d < 0
    back_m_ = cameras.doffs_px > 0 ? std::min(kHorizon_m, 0.9 * product / cameras.doffs_px) : kHorizon_m;
  }

  Orchard build() {
    addBackground();
    addSecondRow();
    addBranches();
    addFruits();
    addCanopy();
    orchard_.scene.num_disparities = disparitiesFor(orchard_.scene);
    return std::move(orchard_);
  }

 private:
  double between(double low, double high) { return random_.between(low, high); }
  Vec3d anywhere(double size) {
    return Vec3d{between(-size, size), between(-size, size), between(-size, size)};
  }
  const Colors& leafColors() { return kLeaves[static_cast<int>(between(0, 3))]; }
  // Half of what the view spans at depth z.
  double halfWidth(double z) const { return 0.5 * z * orchard_.scene.width / orchard_.scene.focal_px; }
  double halfHeight(double z) const { return 0.5 * z * orchard_.scene.height / orchard_.scene.focal_px; }
  // What the image's place (x, y), -1..1 in both directions, shows at depth z.
  Vec3d place(double x, double y, double z) const { return {x * halfWidth(z), y * halfHeight(z), z}; }

  int add(const Surface& surface) {
    orchard_.scene.surfaces.push_back(surface);
    return static_cast<int>(orchard_.scene.surfaces.size()) - 1;
  }
  static Paint paint(const Colors& colors, double cell_m, Pattern pattern) {
    return {colors.first_bgr, colors.second_bgr, cell_m, pattern};
  }

  void addBackground() {
    add({Shape::kPlane,
         {0, 0, back_m_},
         {1, 0, 0},
         {0, 1, 0},
         0,
         paint(kSky, 0.15 * back_m_, Pattern::kMottle)});
    add({Shape::kPlane,
         {0, kCameraHeight_m, 0},
         {1, 0, 0},
         {0, 0, 1},
         0,
         paint(kMeadow, 0.12, Pattern::kMottle)});
    const double hedge_m = std::min(15.0, 0.85 * back_m_);
    for (int i = 0; i < 16; ++i) {
      const Vec3d center = place(-1.2 + 0.16 * i, between(-0.1, 0.05), hedge_m * between(0.9, 1.1));
      const double width_m = halfWidth(hedge_m) * between(0.14, 0.24);
      const double height_m = std::max(kCameraHeight_m, halfHeight(hedge_m) * between(0.25, 0.45));
      add({Shape::kEllipse,
           center,
           {width_m, 0, 0},
           {0, height_m, 0},
           0,
           paint(kHedge, 0.04 * hedge_m, Pattern::kMottle)});
    }
  }

  void addSecondRow() {
    const double row_m = std::min(middle_m_ + 2.4, 0.7 * back_m_);
    for (double x = between(-1.1, -0.7); x < 1.2; x += between(0.5, 0.8)) {
      Vec3d foot = place(x, 0, row_m * between(0.95, 1.05));
      foot[1] = kCameraHeight_m;
      addLimb(foot, {0.02, -1, 0.02}, 0.045, 2.6, 0.12, kBark);
    }
    const int leaves = 700;
    for (int i = 0; i < leaves; ++i) {
      const double x = between(-1.2, 1.2), y = between(-1.3, 0.55);
      addLeaf(place(x, y, row_m * between(0.85, 1.2)), 1.5);
    }
  }

  // A chain of cones with balls at their joints, growing thinner; returns nothing but what it adds.
  void addLimb(Vec3d from, Vec3d direction, double radius_m, double length_m, double wander,
               const Colors& colors) {
    constexpr int kPieces = 7;
    const double half_m = 0.5 * length_m / kPieces, shrink = 0.92;
    const double mean = (1 + shrink) / 2, taper = (1 - shrink) / (1 + shrink);
    for (int i = 0; i < kPieces; ++i) {
      direction = unit(direction + anywhere(wander));
      const Paint bark = paint(colors, std::max(0.004, 0.3 * radius_m), Pattern::kBark);
      add({Shape::kBranch,
           from + direction * half_m,
           {},
           direction * half_m,
           radius_m * mean,
           bark,
           0,
           0,
           taper});
      from += direction * (2 * half_m);
      radius_m *= shrink;
      Paint knot = bark;
      knot.pattern = Pattern::kMottle;
      add({Shape::kSphere, from, {}, {}, radius_m, knot});
    }
  }

  // Trunks and laterals behind the fruit, twigs among it.
  void addBranches() {
    const double behind_m = options_.farthest_m + kLargestRadius_m + 0.05;
    for (double x = between(-0.9, -0.3); x < 1; x += between(0.9, 1.3)) {
      const Vec3d foot = place(x, 1.3, behind_m + between(0.05, 0.15));
      addLimb(foot, {between(-0.15, 0.15), -1, 0}, between(0.022, 0.03), 2.8 * halfHeight(behind_m), 0.1,
              kBark);
    }
    for (int i = 0; i < 7; ++i) {
      const double side = i % 2 == 0 ? -1 : 1;
      const Vec3d from = place(-side * between(0.2, 1.1), -0.9 + 0.3 * i, behind_m + between(0, 0.12));
      const Vec3d along{side, between(-0.5, 0.1), between(-0.1, 0.1)};
      addLimb(from, along, between(0.007, 0.013), 1.6 * halfWidth(behind_m), 0.16, kBark);
    }
    for (int i = 0; i < 12; ++i) {
      const Vec3d from = place(between(-1, 1), between(-1.1, 0.8), behind_m);
      addLimb(from, Vec3d(0, -0.3, -0.3) + anywhere(1), between(0.0025, 0.004), between(0.15, 0.3), 0.25,
              kTwig);
    }
  }

  // Rows and columns of places, each a little off, every third with a partner that touches.
  void addFruits() {
    const double aspect = 1.0 * orchard_.scene.width / orchard_.scene.height;
    const int wanted =
        options_.fruits > 0 ? options_.fruits : std::clamp(static_cast<int>(8 * middle_m_), 6, 14);
    const int rows = std::max(1, static_cast<int>(std::sqrt(wanted / aspect) + 0.5));
    const int columns = (wanted + rows - 1) / rows;
    const int offset = static_cast<int>(between(0, 3));
    for (int i = 0; static_cast<int>(orchard_.fruits.size()) < wanted; ++i) {
      const int cell = i % (rows * columns);
      const double x = (cell % columns + between(0.25, 0.75)) / columns,
                   y = (cell / columns + between(0.25, 0.75)) / rows;
      const Vec3d center =
          place(1.7 * x - 0.85, 1.6 * y - 0.8, between(options_.nearest_m, options_.farthest_m));
      const double radius_m = between(0.033, kLargestRadius_m);
      const bool golden = between(0, 1) < 0.3;
      addFruit(center, radius_m, i, golden);
      if (i % 3 == offset && static_cast<int>(orchard_.fruits.size()) < wanted)
        addPartner(center, radius_m, i, golden);
    }
  }

  // A fruit that touches another one beside it, inside of the band of depths.
  void addPartner(const Vec3d& center, double radius_m, int cluster, bool golden) {
    const double own_m = between(0.033, kLargestRadius_m), apart_m = radius_m + own_m;
    const double side = center[0] > 0 ? -1 : 1;  // towards the image's middle
    const double reach = 0.7 * apart_m, far = center[2] + between(-reach, reach);
    const double depth_m = std::clamp(far, options_.nearest_m, options_.farthest_m) - center[2];
    const double rise_m = between(-0.25, 0.25) * apart_m;
    const double across_m = std::sqrt(std::max(0.0, apart_m * apart_m - depth_m * depth_m - rise_m * rise_m));
    addFruit(center + Vec3d(side * across_m, rise_m, depth_m), own_m, cluster, golden);
  }

  void addFruit(const Vec3d& center, double radius_m, int cluster, bool golden) {
    const double half_height_m = radius_m * between(0.88, 0.98);
    const Vec3d tilt{between(-0.3, 0.3), -1, between(-0.3, 0.3)}, up = unit(tilt);
    const Paint skin = paint(golden ? kGolden : kRed, 0.006, Pattern::kFruit);
    const int surface = add({Shape::kSpheroid, center, {}, up * half_height_m, radius_m, skin});
    const double distance_m = std::sqrt(center.dot(center));
    const double near_m =
        distance_m * Solid(orchard_.scene.surfaces[surface], 0).depthAlong({0, 0, 0}, center);
    orchard_.fruits.push_back({surface, golden ? "golden apple" : "apple", center, radius_m, half_height_m,
                               cluster, distance_m, near_m});
    addLimb(center + up * (0.93 * half_height_m), up + anywhere(0.4), 0.0017, 0.03, 0.1, kTwig);
    if (between(0, 1) < 0.35) return;
    for (double leaf = between(0, 1); leaf < 2; leaf += 1) {
      const Vec3d aside{between(-1, 1), between(-1.2, 0.6), 0};
      const double away = radius_m * between(0.6, 1.25), before = -radius_m * between(0.75, 1.3) - 0.012;
      addLeaf(center + unit(aside) * away + Vec3d(0, 0, before), 1);
    }
  }

  // Leaves behind the fruit, thick enough to hide most of what is farther, and some among it.
  void addCanopy() {
    const double behind_m = options_.farthest_m + kLargestRadius_m;
    const double leaf_m2 = 0.0024, view_m2 = 4 * halfWidth(behind_m) * halfHeight(behind_m);
    const int behind = std::min(4000, static_cast<int>(1.3 * view_m2 / leaf_m2));
    for (int i = 0; i < behind; ++i) {
      const double x = between(-1.1, 1.1), y = between(-1.15, 1.05);
      addLeaf(place(x, y, behind_m + between(0.03, 0.5)), 1);
    }
    for (int i = 0; i < behind / 8; ++i) {
      const double x = between(-1.1, 1.1), y = between(-1.15, 1.05);
      addLeaf(place(x, y, between(options_.nearest_m - 0.01, behind_m)), 1);
    }
  }

  // Leaves hang, and turn their faces to the light more often than not.
  void addLeaf(const Vec3d& center, double scale) {
    const Vec3d hang = Vec3d(0, 0.6, -0.15) + anywhere(0.9), along = unit(hang);
    const Vec3d face = Vec3d(-0.3, -0.6, -0.8) + anywhere(0.9), across = unit(along.cross(face));
    const double length_m = scale * between(0.03, 0.045), width_m = length_m * between(0.42, 0.56);
    const double curl = -between(0.05, 0.4), fold = between(-0.5, 0.3);
    const Paint green = paint(leafColors(), scale * 0.008, Pattern::kFoliage);
    add({Shape::kLeaf, center, along * length_m, across * width_m, 0, green, curl * length_m,
         fold * width_m});
  }

  OrchardOptions options_;
  Random random_;
  double middle_m_, back_m_;
  Orchard orchard_;
};

void requireRange(const char* name, double value, double smallest, double largest) {
  if (!(value >= smallest && value <= largest))
    throw std::invalid_argument(std::string("orchard: ") + name + " is " + std::to_string(value) +
                                "; allowed: " + std::to_string(smallest) + " to " + std::to_string(largest));
}

}  // namespace

Orchard orchard(const SceneDescription& cameras, const OrchardOptions& options) {
  requireRange("nearest_m", options.nearest_m, 0.3, 10);
  requireRange("farthest_m", options.farthest_m, options.nearest_m, 10);
  if (options.fruits < 0 || options.fruits > 200)
    throw std::invalid_argument("orchard: fruits is " + std::to_string(options.fruits) +
                                "; allowed: 0 to 200");
  return OrchardBuilder(cameras, options).build();
}

}  // namespace pomona
