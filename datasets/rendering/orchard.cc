#include "datasets/rendering/orchard.h"

#include <algorithm>
#include <cmath>

#include "datasets/hash.h"
#include "datasets/rendering/nearest_surface.h"
#include "datasets/rendering/require_range.h"
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
constexpr double kSmallestRadius_m = 0.033, kLargestRadius_m = 0.042;

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
  Vec3d place(const Vec3d& p) const { return {p[0] * halfWidth(p[2]), p[1] * halfHeight(p[2]), p[2]}; }

  int add(const Surface& surface) {
    orchard_.scene.surfaces.push_back(surface);
    return static_cast<int>(orchard_.scene.surfaces.size()) - 1;
  }
  static Paint paint(const Colors& colors, double cell_m, Pattern pattern) {
    return {colors.first_bgr, colors.second_bgr, cell_m, pattern};
  }

  void addBackground() {
    const Vec3d right(1, 0, 0), down(0, 1, 0), ahead(0, 0, 1);
    const Paint sky = paint(kSky, 0.06 * back_m_, Pattern::kMottle);
    add({Shape::kPlane, ahead * back_m_, right, down, 0, sky});
    add({Shape::kPlane, down * kCameraHeight_m, right, ahead, 0, paint(kMeadow, 0.12, Pattern::kMottle)});
    const double hedge_m = std::min(15.0, 0.85 * back_m_);
    const Paint leafage = paint(kHedge, 0.02 * hedge_m, Pattern::kMottle);
    for (int i = 0; i < 16; ++i) {
      const Vec3d center = place({-1.2 + 0.16 * i, between(-0.1, 0.05), hedge_m * between(0.9, 1.1)});
      const double width_m = halfWidth(hedge_m) * between(0.14, 0.24);
      const double height_m = std::max(kCameraHeight_m, halfHeight(hedge_m) * between(0.25, 0.45));
      add({Shape::kEllipse, center, right * width_m, down * height_m, 0, leafage});
    }
  }

  void addSecondRow() {
    const double row_m = std::min(middle_m_ + 2.4, 0.7 * back_m_);
    for (double x = between(-1.1, -0.7); x < 1.2; x += between(0.5, 0.8)) {
      Vec3d foot = place({x, 0, row_m * between(0.95, 1.05)});
      foot[1] = kCameraHeight_m;
      addLimb({foot, {0.02, -1, 0.02}, 0.045, 2.6, 0.12, &kBark});
    }
    for (int i = 0; i < 110; ++i) {
      const Vec3d at{between(-1.2, 1.2), between(-1.3, 0.5), row_m * between(0.85, 1.2)};
      addShoot(place(at), 1.5);
    }
  }

  // A chain of cones with balls at their joints, growing thinner.
  struct Limb {
    Vec3d from, direction;
    double radius_m, length_m, wander;
    const Colors* colors;
    int pieces = 7;
  };
  void addLimb(const Limb& limb) {
    const double half_m = 0.5 * limb.length_m / limb.pieces, shrink = 0.92;
    const double mean = (1 + shrink) / 2, taper = (1 - shrink) / (1 + shrink);
    const Paint bark = paint(*limb.colors, std::max(0.004, 0.3 * limb.radius_m), Pattern::kBark);
    Paint knot = bark;
    knot.pattern = Pattern::kMottle;
    Vec3d from = limb.from, along = unit(limb.direction);
    double radius_m = limb.radius_m;
    for (int i = 0; i < limb.pieces; ++i) {
      along = unit(along + anywhere(limb.wander));
      add({Shape::kBranch, from + along * half_m, {}, along * half_m, radius_m * mean, bark, 0, 0, taper});
      from += along * (2 * half_m);
      radius_m *= shrink;
      add({Shape::kSphere, from, {}, {}, radius_m, knot});
    }
  }

  // Trunks and laterals behind the fruit, twigs among it.
  void addBranches() {
    const double behind_m = options_.farthest_m + kLargestRadius_m + 0.05;
    for (double x = between(-0.9, -0.3); x < 1; x += between(0.9, 1.3)) {
      const Vec3d foot{x, 1.3, behind_m + between(0.05, 0.15)}, up{between(-0.15, 0.15), -1, 0};
      addLimb({place(foot), up, between(0.022, 0.03), 2.8 * halfHeight(behind_m), 0.1, &kBark});
    }
    for (int i = 0; i < 7; ++i) {
      const double side = i % 2 == 0 ? -1 : 1;
      const Vec3d from{-side * between(0.2, 1.1), -0.9 + 0.3 * i, behind_m + between(0, 0.12)};
      const Vec3d along{side, between(-0.5, 0.1), between(-0.1, 0.1)};
      addLimb({place(from), along, between(0.007, 0.013), 1.6 * halfWidth(behind_m), 0.16, &kBark});
    }
    for (int i = 0; i < 12; ++i) {
      const Vec3d from{between(-1, 1), between(-1.1, 0.8), behind_m},
          along = Vec3d(0, -0.3, -0.3) + anywhere(1);
      addLimb({place(from), along, between(0.0025, 0.004), between(0.15, 0.3), 0.25, &kTwig});
    }
  }

  // Rows and columns of places, each a little off, every third with a partner that touches.
  void addFruits() {
    const double aspect = 1.0 * orchard_.scene.width / orchard_.scene.height;
    const int wanted =
        options_.fruits > 0 ? options_.fruits : std::clamp(static_cast<int>(8 * middle_m_), 6, 14);
    const int rows = std::max(1, static_cast<int>(std::sqrt(wanted / aspect) + 0.5));
    const int columns = (wanted + rows - 1) / rows;
    const int with_partner = static_cast<int>(between(0, 3)), most_tries = 20 * wanted;
    const auto isFull = [&] { return static_cast<int>(orchard_.fruits.size()) >= wanted; };
    for (int i = 0; i < most_tries && !isFull(); ++i) {
      const int row = i / columns % rows, column = i % columns;
      const double x = (column + between(0.25, 0.75)) / columns, y = (row + between(0.25, 0.75)) / rows;
      const Vec3d at{1.7 * x - 0.85, 1.6 * y - 0.8, between(options_.nearest_m, options_.farthest_m)};
      const double radius_m = between(kSmallestRadius_m, kLargestRadius_m);
      const bool golden = between(0, 1) < 0.3;
      if (!addFruit(place(at), radius_m, i, golden)) continue;
      if (i % 3 == with_partner && !isFull()) addPartner(place(at), radius_m, i, golden);
    }
  }

  // A fruit that touches another one beside it, inside of the band of depths.
  void addPartner(const Vec3d& center, double radius_m, int cluster, bool golden) {
    const double own_m = between(kSmallestRadius_m, kLargestRadius_m), apart_m = radius_m + own_m;
    const double side = center[0] > 0 ? -1 : 1;  // towards the image's middle
    const double reach = 0.7 * apart_m, far = center[2] + between(-reach, reach);
    const double depth_m = std::clamp(far, options_.nearest_m, options_.farthest_m) - center[2];
    const double rise_m = between(-0.25, 0.25) * apart_m;
    const double across_m = std::sqrt(std::max(0.0, apart_m * apart_m - depth_m * depth_m - rise_m * rise_m));
    addFruit(center + Vec3d(side * across_m, rise_m, depth_m), own_m, cluster, golden);
  }

  // False if there is one already.
  bool addFruit(const Vec3d& center, double radius_m, int cluster, bool golden) {
    for (const Fruit& other : orchard_.fruits) {
      const Vec3d apart = center - other.center_m;
      const double least_m = 0.999 * (radius_m + other.radius_m);
      if (apart.dot(apart) < least_m * least_m) return false;
    }
    const double half_height_m = radius_m * between(0.88, 0.98);
    const Vec3d tilt{between(-0.3, 0.3), -1, between(-0.3, 0.3)}, up = unit(tilt);
    const Paint skin = paint(golden ? kGolden : kRed, 0.006, Pattern::kFruit);
    const int surface = add({Shape::kSpheroid, center, {}, up * half_height_m, radius_m, skin});
    const double distance_m = std::sqrt(center.dot(center));
    const Solid solid(orchard_.scene.surfaces[surface], 0);
    orchard_.fruits.push_back({surface, golden ? "golden apple" : "apple", center, radius_m, half_height_m,
                               cluster, distance_m, distance_m * solid.depthAlong({0, 0, 0}, center)});
    addLimb({center + up * (0.93 * half_height_m), up + anywhere(0.4), 0.0017, 0.03, 0.1, &kTwig, 3});
    addCover(center, radius_m);
    return true;
  }

  // Up to three leaves before a fruit, over its rim or farther in.
  void addCover(const Vec3d& center, double radius_m) {
    constexpr double kMostLeaves = 3.6, kClearance_m = 0.012;
    for (double leaf = between(0.2, kMostLeaves); leaf >= 1; leaf -= 1) {
      const Vec3d aside{between(-1, 1), between(-1.2, 0.8), 0};
      const Vec3d away{between(0.3, 1.1), between(0.8, 1.2), 0};
      addLeaf(center + unit(aside) * (radius_m * away[0]) - Vec3d(0, 0, radius_m * away[1] + kClearance_m),
              1);
    }
  }

  // Shoots behind the fruit, thick enough to hide most of what is farther, and some among it.
  void addCanopy() {
    const double behind_m = options_.farthest_m + kLargestRadius_m;
    const double shoot_m2 = 0.016, view_m2 = 4 * halfWidth(behind_m) * halfHeight(behind_m);
    const int behind = std::min(600, static_cast<int>(1.5 * view_m2 / shoot_m2));
    for (int i = 0; i < behind; ++i) {
      const Vec3d at{between(-1.1, 1.1), between(-1.15, 1.05), behind_m + between(0.06, 0.5)};
      addShoot(place(at), 1);
    }
    for (int i = 0; i < behind; ++i) {
      const Vec3d at{between(-1.1, 1.1), between(-1.15, 1.05), between(options_.nearest_m, behind_m)};
      addLeaf(place(at), 1);
    }
  }

  // A twig with leaves to both sides.
  void addShoot(const Vec3d& from, double scale) {
    constexpr int kLeaves = 7;
    const Vec3d along = unit(Vec3d(0, -0.4, -0.2) + anywhere(1));
    const double length_m = scale * between(0.1, 0.2);
    addLimb({from, along, scale * 0.0018, length_m, 0.05, &kTwig, 2});
    for (int i = 1; i <= kLeaves; ++i)
      addLeaf(from + along * (length_m * i / kLeaves) + anywhere(0.028 * scale), scale);
  }

  // Leaves hang, and turn their faces to the light more often than not.
  void addLeaf(const Vec3d& center, double scale) {
    const Vec3d along = unit(Vec3d(0, 0.6, -0.15) + anywhere(0.9));
    const Vec3d across = unit(along.cross(Vec3d(-0.3, -0.6, -0.8) + anywhere(0.9)));
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

}  // namespace

Orchard orchard(const SceneDescription& cameras, const OrchardOptions& options) {
  requireRange("orchard: nearest_m", options.nearest_m, 0.3, 10);
  requireRange("orchard: farthest_m", options.farthest_m, options.nearest_m, 10);
  requireRange("orchard: fruits", options.fruits, 0, 200);
  return OrchardBuilder(cameras, options).build();
}

}  // namespace pomona
