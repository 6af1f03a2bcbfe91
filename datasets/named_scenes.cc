#include "datasets/named_scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "datasets/hash.h"

namespace pomona {
namespace {

using cv::Vec3d;

Vec3d unit(const Vec3d& v) {
  return v * (1 / std::sqrt(v.dot(v)));
}

struct Colors {
  Vec3d first_bgr, second_bgr;
};

constexpr double kFine_px = 8, kMiddle_px = 12,
                 kCoarse_px = 16;  // coarsest cells of the paint, as seen in the image

const Colors kMeadow{{30, 70, 40}, {90, 190, 140}};
const Colors kHedge{{25, 45, 20}, {80, 130, 70}};
const Colors kLeaf{{20, 80, 30}, {70, 200, 110}};
const Colors kBark{{20, 35, 50}, {85, 120, 150}};
const Colors kApple{{25, 15, 120}, {60, 80, 250}};
const Colors kPear{{20, 120, 150}, {80, 220, 240}};
const Colors kWall{{110, 120, 130}, {215, 220, 225}};
const Colors kFloor{{50, 70, 100}, {130, 165, 200}};

// What the left image shall show: positions and sizes are fractions of its width (y: of its height), `share`
// is the fraction of the largest disparity. Braced lists are evaluated from left to right, so that every
// compiler draws the random numbers in the same order; function arguments would not be.
struct Place {
  double x, y, share;
};
struct Panel {
  Shape shape;  // kParallelogram or kEllipse
  Place place;
  double half_width, half_height;
  double turn, tilt, roll;  // dZ/dX and dZ/dY of the surface, dY/dX of its lower edge
  Colors colors;
};
struct Box {
  Place place;  // of the middle of its lower face
  double half_width, half_height, half_length;
  double turn;
  Colors colors;
};
struct Ball {
  Place place;
  double radius;
  Colors colors;
};

class SceneBuilder {
 public:
  SceneBuilder(std::uint64_t seed, const SceneDescription& cameras, int num_disparities)
      : random_(seed), scene_(cameras) {
    scene_.num_disparities = num_disparities;
    scene_.seed = seed;
  }

  SceneDescription take() { return std::move(scene_); }
  double between(double low, double high) { return random_.between(low, high); }
  Colors anyColors() {
    const Vec3d dark{between(10, 90), between(10, 90), between(10, 90)};
    const Vec3d step{between(60, 165), between(60, 165), between(60, 165)};
    return {dark, dark + step};
  }

  // The plane through three points.
  void plane(Place a, Place b, Place c, const Colors& colors, double cell_px) {
    add({Shape::kPlane, at(a), at(b) - at(a), at(c) - at(a), 0, paint(colors, cell_px, a)});
  }
  void panel(const Panel& p) {
    const double width_m = widthAt(p.place);
    const Vec3d u = unit({1, p.roll, 0}) * (p.half_width * width_m);
    const Vec3d v = unit({-p.roll, 1, 0}) * (p.half_height * width_m);
    add({p.shape, at(p.place), u + Vec3d(0, 0, p.turn * u[0] + p.tilt * u[1]),
         v + Vec3d(0, 0, p.turn * v[0] + p.tilt * v[1]), 0, paint(p.colors, kMiddle_px, p.place)});
  }
  void ball(const Ball& b) {
    add({Shape::kSphere,
         at(b.place),
         {},
         {},
         b.radius * widthAt(b.place),
         paint(b.colors, kFine_px, b.place)});
  }
  // An upright cuboid turned about its vertical axis.
  void box(const Box& b) {
    const double width_m = widthAt(b.place);
    const Vec3d u = unit({1, 0, b.turn}) * (b.half_width * width_m);
    const Vec3d v{0, b.half_height * width_m, 0};
    const Vec3d w = unit({-b.turn, 0, 1}) * (b.half_length * width_m);
    const Vec3d center = at(b.place) - v;  // Y points down
    const Paint p = paint(b.colors, kMiddle_px, b.place);
    for (const double side : {-1.0, 1.0}) {
      add({Shape::kParallelogram, center + side * w, u, v, 0, p});
      add({Shape::kParallelogram, center + side * v, u, w, 0, p});
      add({Shape::kParallelogram, center + side * u, v, w, 0, p});
    }
  }

 private:
  double depthAt(double share) const {
    return scene_.focal_px * scene_.baseline_m / (share * scene_.num_disparities + scene_.doffs_px);
  }
  // Metres that the image's width spans at the place's depth.
  double widthAt(Place p) const { return depthAt(p.share) * scene_.width / scene_.focal_px; }
  Vec3d at(Place p) const {
    const double width_m = widthAt(p);
    return {(p.x - 0.5) * width_m, (p.y - 0.5) * width_m * scene_.height / scene_.width, depthAt(p.share)};
  }
  Paint paint(const Colors& colors, double cell_px, Place place) const {
    return {colors.first_bgr, colors.second_bgr, cell_px * depthAt(place.share) / scene_.focal_px};
  }
  void add(const Surface& surface) { scene_.surfaces.push_back(surface); }

  Random random_;
  SceneDescription scene_;
};

void addPlanes(SceneBuilder& b) {
  b.plane({0.5, 0.5, 0.25}, {1, 0.5, 0.3}, {0.5, 1, 0.4}, kWall, kCoarse_px);
  for (const double share : {0.42, 0.56, 0.68, 0.78})
    b.panel({Shape::kParallelogram,
             {b.between(0.15, 0.85), b.between(0.2, 0.8), share},
             b.between(0.08, 0.16),
             b.between(0.06, 0.14),
             b.between(-0.6, 0.6),
             b.between(-0.6, 0.6),
             b.between(-0.5, 0.5),
             b.anyColors()});
}

void addBoxes(SceneBuilder& b) {
  b.plane({0.5, 0.5, 0.2}, {1, 0.5, 0.23}, {0.5, 0, 0.2}, kWall, kCoarse_px);
  b.plane({0.5, 0.6, 0.3}, {1, 0.6, 0.3}, {0.5, 1, 0.7}, kFloor, kMiddle_px);
  double x = 0.12;
  for (const double share : {0.38, 0.55, 0.42, 0.62, 0.46}) {
    const double floor_y = 0.6 + (share - 0.3);
    b.box({{x, floor_y, share},
           b.between(0.05, 0.09),
           b.between(0.06, 0.12),
           b.between(0.03, 0.06),
           b.between(-0.8, 0.8),
           b.anyColors()});
    x += 0.19;
  }
}

void addSpheres(SceneBuilder& b) {
  b.plane({0.5, 0.5, 0.25}, {1, 0.5, 0.2}, {0.5, 1, 0.45}, kFloor, kCoarse_px);
  for (int i = 0; i < 9; ++i)
    b.ball({{b.between(0.05, 0.95), b.between(0.1, 0.9), b.between(0.4, 0.85)},
            b.between(0.03, 0.09),
            b.anyColors()});
}

// One tree: a trunk, thin branches, leaves that turn every way, and fruit among them.
void addTree(SceneBuilder& b, double x, double share) {
  b.panel({Shape::kParallelogram, {x, 0.62, share}, 0.014, 0.3, 0.1, 0, b.between(-0.06, 0.06), kBark});
  for (int i = 0; i < 7; ++i)
    b.panel({Shape::kParallelogram,
             {x + b.between(-0.07, 0.07), b.between(0.15, 0.5), share * b.between(0.95, 1.1)},
             0.08,
             0.004,
             b.between(-0.3, 0.3),
             0,
             b.between(-0.9, 0.9),
             kBark});
  for (int i = 0; i < 90; ++i)
    b.panel({Shape::kEllipse,
             {x + b.between(-0.15, 0.15), b.between(0.04, 0.56), share * b.between(0.8, 1.25)},
             b.between(0.014, 0.024),
             b.between(0.006, 0.01),
             b.between(-1, 1),
             b.between(-1, 1),
             b.between(-1.5, 1.5),
             kLeaf});
  for (int i = 0; i < 8; ++i)
    b.ball({{x + b.between(-0.13, 0.13), b.between(0.1, 0.54), share * b.between(1.1, 1.35)},
            b.between(0.018, 0.026),
            i % 4 == 3 ? kPear : kApple});
}

// Trees of one row, before the hedge at the meadow's end.
void addTrees(SceneBuilder& b) {
  b.plane({0.5, 0.5, 0.16}, {1, 0.5, 0.2}, {0.5, 0, 0.16}, kHedge, kCoarse_px);
  b.plane({0.5, 0.62, 0.22}, {1, 0.62, 0.22}, {0.5, 1, 0.6}, kMeadow, kMiddle_px);
  for (const double x : {0.17, 0.49, 0.83}) addTree(b, x, b.between(0.45, 0.65));
}

struct NamedScene {
  const char* name;
  void (*add)(SceneBuilder&);
};
constexpr NamedScene kScenes[] = {
    {"boxes", addBoxes}, {"planes", addPlanes}, {"spheres", addSpheres}, {"trees", addTrees}};

void requireRange(const char* name, int value, int smallest, int largest) {
  if (value < smallest || value > largest)
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                "; allowed: " + std::to_string(smallest) + " to " + std::to_string(largest));
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const NamedScene& scene : kScenes) names.emplace_back(scene.name);
  return names;
}

SceneDescription namedScene(std::string_view name, std::uint64_t seed, int width, int height,
                            int num_disparities) {
  SceneDescription cameras;
  cameras.width = width;
  cameras.height = height;
  cameras.focal_px = width;  // a horizontal field of view of 53 degrees
  cameras.baseline_m = 0.12;
  return namedScene(name, seed, cameras, num_disparities);
}

SceneDescription namedScene(std::string_view name, std::uint64_t seed, const SceneDescription& cameras,
                            int num_disparities) {
  constexpr int kSmallestSide = 16, kLargestSide = 8192, kFewestDisparities = 8;
  requireRange("width", cameras.width, kSmallestSide, kLargestSide);
  requireRange("height", cameras.height, kSmallestSide, kLargestSide);
  if (num_disparities == 0) num_disparities = std::max(kFewestDisparities, cameras.width / 10);
  requireRange("num_disparities", num_disparities, kFewestDisparities, cameras.width / 2);
  std::string allowed;
  for (const NamedScene& scene : kScenes) {
    if (name == scene.name) {
      SceneBuilder builder(seed, cameras, num_disparities);
      scene.add(builder);
      return builder.take();
    }
    allowed += (allowed.empty() ? "" : ", ") + std::string(scene.name);
  }
  throw std::invalid_argument("scene is '" + std::string(name) + "'; allowed: " + allowed);
}

}  // namespace pomona
