#include "datasets/rendering/storefront.h"

#include <algorithm>
#include <cmath>

#include "datasets/hash.h"
#include "datasets/rendering/angle.h"
#include "datasets/rendering/nearest_surface.h"
#include "datasets/rendering/require_range.h"

namespace pomona {
namespace {

using cv::Vec3d;

constexpr const char* kNames[] = {"BAKERY", "BOOKS", "CAFE", "FLOWERS", "FRUIT",   "HATS", "OPTIK", "PIZZA",
                                  "RADIO",  "SHOES", "TEA",  "TOYS",    "WATCHES", "WINE", "YARN",  "ZOO"};
constexpr int kNameCount = static_cast<int>(std::size(kNames));
constexpr double kCameraHeight_m = 1.4;

// A wall's own axes: along it to the right, down, and out of it towards the street.
struct Wall {
  Vec3d center, right, down, out;
  double half_width_m, half_height_m, yaw_deg;

  Vec3d at(double a, double b, double out_m) const {
    return center + right * (a * half_width_m) + down * (b * half_height_m) + out * out_m;
  }
};

class StorefrontBuilder {
 public:
  StorefrontBuilder(const SceneDescription& cameras, const StorefrontOptions& options)
      : options_(options), random_(hash(options.seed) ^ 0x73686f70u) {
    street_.scene = cameras;
    street_.scene.seed = options.seed;
    street_.scene.sun = true;
  }

  Storefront build() {
    addStreet();
    const int first_name = static_cast<int>(between(0, kNameCount));
    for (int i = 0; i < options_.walls; ++i) addShop(wallOf(i), i, first_name);
    street_.scene.num_disparities = disparitiesFor(street_.scene);
    return std::move(street_);
  }

 private:
  double between(double low, double high) { return random_.between(low, high); }
  Vec3d color(double low, double high) {
    return Vec3d{between(low, high), between(low, high), between(low, high)};
  }

  void addPanel(const Wall& wall, double a, double b, double half_a, double half_b, double out_m,
                const Paint& paint) {
    street_.scene.surfaces.push_back({Shape::kParallelogram, wall.at(a, b, out_m),
                                      wall.right * (half_a * wall.half_width_m),
                                      wall.down * (half_b * wall.half_height_m), 0, paint});
  }

  void addStreet() {
    const SceneDescription& s = street_.scene;
    double behind_m = options_.farthest_m * 1.8 + 2;
    if (s.doffs_px > 0) behind_m = std::min(behind_m, 0.95 * s.focal_px * s.baseline_m / s.doffs_px);
    const double half_m = behind_m * s.width / s.focal_px;
    const Paint plaster{{110, 125, 135}, {170, 185, 195}, 0.3, Pattern::kMottle};
    street_.scene.surfaces.push_back({Shape::kPlane, {0, 0, behind_m}, {1, 0, 0}, {0, 1, 0}, 0, plaster});
    const Wall house{{0, 0, behind_m}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, half_m, half_m, 0};
    const double floor_m = std::max(0.8, 0.2 * half_m);
    for (double x = -half_m; x < half_m; x += floor_m)
      for (double y = -half_m; y < 0.5 * floor_m; y += floor_m)
        addPanel(house, x / half_m, y / half_m, 0.25 * floor_m / half_m, 0.33 * floor_m / half_m, 0.02,
                 glass());
    const Paint pavement{{85, 90, 95}, {150, 155, 160}, 0.1, Pattern::kMottle};
    street_.scene.surfaces.push_back(
        {Shape::kPlane, {0, kCameraHeight_m, 0}, {1, 0, 0}, {0, 0, 1}, 0, pavement});
  }

  // The walls share the view's width; one that turns away becomes longer, so as to look as wide.
  Wall wallOf(int number) {
    const SceneDescription& s = street_.scene;
    const double z = between(options_.nearest_m, options_.farthest_m);
    const double yaw = between(options_.least_yaw_deg, options_.greatest_yaw_deg);
    const cv::Vec2d turn = cosineAndSine(yaw);
    const double share = (2.0 * number + 1) / options_.walls - 1;  // of half the view, -1..1
    const double half_view_m = 0.5 * z * s.width / s.focal_px;
    const double half_width_m =
        0.92 * half_view_m / options_.walls / turn[0] * (turn[0] - 0.2 * std::abs(turn[1]));
    const double half_height_m = std::min(0.42 * z * s.height / s.focal_px, 0.95 * kCameraHeight_m);
    const Vec3d right(turn[0], 0, turn[1]), out(turn[1], 0, -turn[0]);
    return {{share * half_view_m, 0, z}, right, {0, 1, 0}, out, half_width_m, half_height_m, yaw};
  }

  Paint glass() { return {color(35, 60), color(80, 120), 0.12, Pattern::kMottle}; }

  void addShop(const Wall& wall, int number, int first_name) {
    const Vec3d clay{between(60, 120), between(80, 130), between(110, 175)};
    addPanel(wall, 0, 0, 1, 1, 0, {clay * 0.75, clay * 1.15, 0.22, Pattern::kBrick});
    const double ground = kCameraHeight_m / wall.half_height_m;
    addPanel(wall, 0, (ground + 1) / 2, 1, (ground - 1) / 2, 0,
             {clay * 0.4, clay * 0.7, 0.1, Pattern::kMottle});
    addSign(wall, number, kNames[(first_name + 2 * number) % kNameCount], {0, -0.62}, 0.86, 0.2);
    addSign(wall, number, kNames[(first_name + 2 * number + 1) % kNameCount],
            {between(-0.35, -0.15), between(0.62, 0.7)}, 0.5, 0.13);
    const double door = between(0.55, 0.65);
    addPanel(wall, -0.3, 0.08, 0.55, 0.36, 0.015, glass());
    for (int i = 0; i < 5; ++i) {  // goods behind the glass, as posters on it
      const Vec3d dark = color(30, 110), bright = dark + color(50, 120);
      const double height = between(0.1, 0.2), middle = between(0, 0.2);
      addPanel(wall, -0.7 + 0.2 * i, middle, 0.07, height, 0.02, {dark, bright, 0.05, Pattern::kMottle});
    }
    addPanel(wall, door, 0.33, 0.2, 0.6, 0.02, {color(20, 60), color(70, 120), 0.05, Pattern::kMottle});
    addSign(wall, number, "OPEN", {door, 0.05}, 0.19, 0.04);
  }

  void addSign(const Wall& wall, int number, const char* text, const cv::Vec2d& place, double half_a,
               double half_b) {
    const Vec3d paper = color(160, 215), ink = color(10, 110);
    const bool inverse = between(0, 1) < 0.4;
    const double out_m = 0.035;
    addPanel(wall, place[0], place[1], half_a, half_b, out_m,
             {inverse ? ink : paper, inverse ? paper : ink, 0.04, Pattern::kSign, text});
    const Surface& s = street_.scene.surfaces.back();
    const int surface = static_cast<int>(street_.scene.surfaces.size()) - 1;
    street_.signs.push_back({surface, number, text, s.center, s.u, s.v, wall.yaw_deg});
  }

  StorefrontOptions options_;
  Random random_;
  Storefront street_;
};

}  // namespace

Storefront storefront(const SceneDescription& cameras, const StorefrontOptions& options) {
  requireRange("storefront: walls", options.walls, 1, 8);
  requireRange("storefront: nearest_m", options.nearest_m, 0.5, 20);
  requireRange("storefront: farthest_m", options.farthest_m, options.nearest_m, 20);
  requireRange("storefront: least_yaw_deg", options.least_yaw_deg, -60, 60);
  requireRange("storefront: greatest_yaw_deg", options.greatest_yaw_deg, options.least_yaw_deg, 60);
  return StorefrontBuilder(cameras, options).build();
}

}  // namespace pomona
