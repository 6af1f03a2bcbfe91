#include "datasets/rendering/indoor.h"

#include <algorithm>

#include "datasets/hash.h"
#include "datasets/rendering/angle.h"
#include "datasets/rendering/nearest_surface.h"
#include "datasets/rendering/require_range.h"

namespace pomona {
namespace {

using cv::Vec3d;

constexpr double kWallBehind_m = 1.5;

class IndoorBuilder {
 public:
  IndoorBuilder(const SceneDescription& cameras, const IndoorOptions& options)
      : options_(options), random_(hash(options.seed) ^ 0x726f6f6du) {
    room_.scene = cameras;
    room_.scene.seed = options.seed;
    room_.scene.sun = true;
  }

  Indoor build() {
    addRoom();
    for (int i = 0; i < options_.obstacles; ++i) addObstacle(i);
    room_.scene.num_disparities = disparitiesFor(room_.scene);
    return std::move(room_);
  }

 private:
  double between(double low, double high) { return random_.between(low, high); }

  /// Half the width that the view has at depth z.
  double halfViewM(double z) const { return 0.5 * z * room_.scene.width / room_.scene.focal_px; }

  Paint paint(const Vec3d& mean_bgr, double contrast, double cell_m) {
    const Vec3d half = Vec3d::all(contrast / 2);
    return {mean_bgr - half, mean_bgr + half, cell_m, Pattern::kMottle};
  }

  void add(Shape shape, const Vec3d& center, const Vec3d& u, const Vec3d& v, const Paint& paint) {
    room_.scene.surfaces.push_back({shape, center, u, v, 0, paint});
  }

  void addRoom() {
    const double floor_m = options_.camera_height_m, wall_m = options_.farthest_m + kWallBehind_m;
    add(Shape::kPlane, {0, floor_m, 0}, {1, 0, 0}, {0, 0, 1}, paint({118, 124, 128}, options_.contrast, 0.1));
    add(Shape::kPlane, {0, 0, wall_m}, {1, 0, 0}, {0, 1, 0}, paint({150, 156, 160}, options_.contrast, 0.2));
    for (const double side : {-0.5, 0.45}) {
      const double size_m = between(0.25, 0.4);
      add(Shape::kParallelogram, {side * halfViewM(wall_m), -between(0.5, 0.8), wall_m - 0.02},
          {size_m, 0, 0}, {0, 0.7 * size_m, 0}, paint({120, 125, 130}, 3 * options_.contrast, 0.1));
    }
  }

  // The boxes share the width of the view, each in a lane of its own.
  void addObstacle(int number) {
    const double z = between(options_.nearest_m, options_.farthest_m);
    const double lane = (2.0 * number + 1) / options_.obstacles - 1;
    const double half_lane_m = halfViewM(z) / options_.obstacles;
    const double half_width_m = std::min(0.35, between(0.35, 0.6) * half_lane_m);
    const double half_height_m = between(0.08, 0.25), half_length_m = between(0.08, 0.2);
    const Vec3d turn_right = turned(between(-25, 25));
    const Vec3d u = turn_right * half_width_m, v{0, half_height_m, 0};
    const Vec3d w = Vec3d(-turn_right[2], 0, turn_right[0]) * half_length_m;
    const Vec3d near{lane * halfViewM(z), options_.camera_height_m - half_height_m, z};
    const Vec3d color{between(85, 150), between(85, 150), between(85, 150)};
    const Paint card = paint(color, 3 * options_.contrast, 0.06);
    room_.obstacles.push_back({static_cast<int>(room_.scene.surfaces.size()), near, 2 * half_height_m});
    add(Shape::kParallelogram, near, u, v, card);
    add(Shape::kParallelogram, near + w * 2, u, v, card);
    add(Shape::kParallelogram, near + w - u, w, v, card);
    add(Shape::kParallelogram, near + w + u, w, v, card);
    add(Shape::kParallelogram, near + w - v, u, w, card);
  }

  static Vec3d turned(double degrees) {
    const cv::Vec2d turn = cosineAndSine(degrees);
    return {turn[0], 0, turn[1]};
  }

  IndoorOptions options_;
  Random random_;
  Indoor room_;
};

}  // namespace

Indoor indoor(const SceneDescription& cameras, const IndoorOptions& options) {
  requireRange("indoor: obstacles", options.obstacles, 0, 20);
  requireRange("indoor: nearest_m", options.nearest_m, 0.5, 20);
  requireRange("indoor: farthest_m", options.farthest_m, options.nearest_m, 20);
  requireRange("indoor: camera_height_m", options.camera_height_m, 0.1, 3);
  requireRange("indoor: contrast", options.contrast, 1, 200);
  return IndoorBuilder(cameras, options).build();
}

}  // namespace pomona
