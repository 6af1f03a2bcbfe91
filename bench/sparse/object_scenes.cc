#include "bench/sparse/object_scenes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "datasets/hash.h"
#include "datasets/rendering/angle.h"
#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/storefront.h"

namespace pomona {
namespace {

using cv::Vec3d;

// Half the light of a clear picture is lost to noise of this size: a plain camera indoors.
CameraEffects plainCamera(std::uint64_t seed) {
  CameraEffects effects;
  effects.blur_px = 0.5;
  effects.shot_noise = 3;
  effects.read_noise = 1;
  effects.noise_seed = seed;
  return effects;
}

cv::Scalar colorOf(Random& random, double low, double high) {
  const double blue = random.between(low, high), green = random.between(low, high);
  return {blue, green, random.between(low, high)};
}

cv::Point2d pixelOf(const SceneDescription& scene, const Vec3d& point_m, bool right_view = false) {
  const cv::Vec2d principal = principalOf(scene);
  const double x_m = point_m[0] - (right_view ? scene.baseline_m : 0);
  return {scene.focal_px * x_m / point_m[2] + principal[0] + (right_view ? scene.doffs_px : 0),
          scene.focal_px * point_m[1] / point_m[2] + principal[1]};
}

std::vector<Vec3d> cornersOf(const Surface& s) {
  return {s.center - s.u - s.v, s.center + s.u - s.v, s.center + s.u + s.v, s.center - s.u + s.v};
}

cv::Rect2f boxOf(const SceneDescription& scene, const Surface& s, bool right_view) {
  std::vector<cv::Point2f> corners;
  for (const Vec3d& corner : cornersOf(s)) corners.emplace_back(pixelOf(scene, corner, right_view));
  const auto [least_x, most_x] =
      std::minmax_element(corners.begin(), corners.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [least_y, most_y] =
      std::minmax_element(corners.begin(), corners.end(), [](auto& a, auto& b) { return a.y < b.y; });
  return {cv::Point2f(least_x->x, least_y->y), cv::Point2f(most_x->x, most_y->y)};
}

// Of pixel centres in the picture: the first one is half a pixel from the surface's corner.
cv::Matx33d imageFromPicture(const SceneDescription& scene, const Surface& s) {
  const cv::Size size = s.paint.picture.size();
  const double per_x = 2.0 / size.width, per_y = 2.0 / size.height;
  const Vec3d corner = s.center - s.u * (1 - per_x / 2) - s.v * (1 - per_y / 2);
  const cv::Vec2d principal = principalOf(scene);
  const cv::Matx33d camera(scene.focal_px, 0, principal[0], 0, scene.focal_px, principal[1], 0, 0, 1);
  const Vec3d u = s.u * per_x, v = s.v * per_y;
  return camera * cv::Matx33d(u[0], v[0], corner[0], u[1], v[1], corner[1], u[2], v[2], corner[2]);
}

void write(cv::Mat& picture, const std::string& text, cv::Point at, double scale, const cv::Scalar& color,
           int thickness) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_DUPLEX, scale, color, thickness, cv::LINE_AA);
}

SceneDescription emptyRoom(std::uint64_t seed) {
  SceneDescription scene;
  scene.width = 640;
  scene.height = 480;
  scene.focal_px = 560;
  scene.baseline_m = 0.06;
  scene.num_disparities = 48;
  scene.seed = seed;
  const Paint bricks{{60, 75, 110}, {95, 110, 150}, 0.22, Pattern::kBrick};
  scene.surfaces.push_back({Shape::kParallelogram, {0, 0, 4}, {3, 0, 0}, {0, 2.2, 0}, 0, bricks});
  return scene;
}

// A picture, turned about the vertical axis and then in its own plane.
Surface panel(const Vec3d& center, double half_width_m, double half_height_m, double yaw_deg, double roll_deg,
              const cv::Mat& picture) {
  const cv::Vec2d yaw = cosineAndSine(yaw_deg), roll = cosineAndSine(roll_deg);
  const Vec3d right(yaw[0], 0, yaw[1]), down(0, 1, 0);
  Paint paint;
  paint.pattern = Pattern::kPicture;
  paint.picture = picture;
  return {Shape::kParallelogram,
          center,
          (right * roll[0] + down * roll[1]) * half_width_m,
          (down * roll[0] - right * roll[1]) * half_height_m,
          0,
          paint};
}

Storefront shopFront(double depth_m, double yaw_deg, std::uint64_t seed) {
  StorefrontOptions options;
  options.seed = seed;
  options.walls = 1;
  options.nearest_m = options.farthest_m = depth_m;
  options.least_yaw_deg = options.greatest_yaw_deg = yaw_deg;
  return storefront(sceneFor(namedRig("seed-003")), options);
}

// A shop front with `sign`, which hung frontally, in place of its own.
SignScene sceneOf(const Surface& sign, double depth_m, double yaw_deg, std::uint64_t seed) {
  SignScene scene;
  scene.depth_m = depth_m;
  scene.yaw_deg = yaw_deg;
  Storefront street = shopFront(depth_m, yaw_deg, seed);
  const double half_view_m = 0.5 * depth_m * street.scene.width / street.scene.focal_px;
  const double aside_m = Random(seed).between(-0.3, 0.3) * half_view_m;
  for (Surface& surface : street.scene.surfaces) surface.center[0] += aside_m;
  Surface& hung = street.scene.surfaces[street.signs[0].surface];
  const cv::Vec2d turn = cosineAndSine(yaw_deg);
  hung.paint = sign.paint;
  hung.u = Vec3d(turn[0], 0, turn[1]) * cv::norm(sign.u);
  hung.v = sign.v;
  scene.distance_m = cv::norm(hung.center);
  scene.bearing_deg = std::atan2(hung.center[0], hung.center[2]) * 180 / CV_PI;
  scene.left_box_px = boxOf(street.scene, hung, false);
  scene.right_box_px = boxOf(street.scene, hung, true);
  for (const Vec3d& corner : cornersOf(hung)) scene.outline_px.push_back(pixelOf(street.scene, corner));
  scene.pair = render(street.scene, plainCamera(seed));
  return scene;
}

}  // namespace

cv::Mat signPicture() {
  const cv::Scalar ground(205, 225, 235), ink(70, 40, 20), red(40, 40, 190);
  cv::Mat picture(240, 720, CV_8UC3, ground);
  cv::rectangle(picture, {10, 10}, {709, 229}, ink, 6);
  cv::circle(picture, {120, 120}, 82, red, cv::FILLED, cv::LINE_AA);
  cv::circle(picture, {120, 120}, 62, ground, cv::FILLED, cv::LINE_AA);
  const std::vector<cv::Point> leaf{{120, 66}, {150, 120}, {132, 168}, {108, 168}, {84, 128}};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{leaf}, ink, cv::LINE_AA);
  write(picture, "POMONA", {226, 140}, 3.4, ink, 11);
  write(picture, "FRUIT & GREENS  SINCE 1897", {232, 196}, 1.0, red, 2);
  return picture;
}

cv::Mat coverPicture(int number) {
  Random random(1000 + static_cast<std::uint64_t>(number));
  const bool dark = random.between(0, 1) < 0.5;
  const auto paper = [&] { return dark ? colorOf(random, 20, 90) : colorOf(random, 160, 230); };
  const auto ink = [&] { return dark ? colorOf(random, 150, 240) : colorOf(random, 10, 110); };
  cv::Mat picture(480, 360, CV_8UC3, paper());
  for (int i = 0; i < 14; ++i) {
    const cv::Point at(int(random.between(20, 340)), int(random.between(120, 400)));
    const int size = int(random.between(12, 60));
    if (random.between(0, 1) < 0.5)
      cv::circle(picture, at, size / 2, ink(), random.between(0, 1) < 0.5 ? cv::FILLED : 3, cv::LINE_AA);
    else
      cv::rectangle(picture, {at.x, at.y, size, int(random.between(8, 50))}, ink(), cv::FILLED);
  }
  const auto word = [&](int letters) {
    std::string text;
    for (int i = 0; i < letters; ++i) text += static_cast<char>('A' + int(random.between(0, 26)));
    return text;
  };
  write(picture, word(7), {24, 62}, 2.0, ink(), 5);
  write(picture, word(9), {26, 104}, 1.1, ink(), 2);
  for (int line = 0; line < 4; ++line)
    write(picture, word(5) + ' ' + word(8), {28, 420 + 15 * line}, 0.5, ink(), 1);
  return picture;
}

SignScene signScene(int number) {
  constexpr double kDepths_m[] = {5.48, 8.53, 11.58, 14.63};
  return sceneOf(panel({}, 1.2, 0.4, 0, 0, signPicture()), kDepths_m[number / 7], 15.0 * (number % 7 - 3),
                 100 + static_cast<std::uint64_t>(number));
}

StreetSign streetSign(std::uint64_t seed, bool wide) {
  constexpr double kDepth_m = 4;
  const Storefront street = shopFront(kDepth_m, 0, seed);
  StreetSign sign{street.scene.surfaces[street.signs[wide ? 0 : 1].surface], {}};
  const cv::Mat view = render(street.scene, plainCamera(seed)).left.image;
  sign.picture = view(cv::Rect(boxOf(street.scene, sign.surface, false))).clone();
  return sign;
}

SignScene signScene(const StreetSign& sign, double depth_m, double yaw_deg, std::uint64_t seed) {
  return sceneOf(sign.surface, depth_m, yaw_deg, seed);
}

ObjectScene objectScene(int number) {
  Random random(2000 + static_cast<std::uint64_t>(number));
  SceneDescription scene = emptyRoom(static_cast<std::uint64_t>(number));
  for (int i = 0; i < 6; ++i)  // posters, never of the covers in question
    scene.surfaces.push_back(panel({-1.9 + 0.76 * i, random.between(-0.9, 0.9), 3.97}, 0.33, 0.44, 0,
                                   random.between(-10, 10),
                                   coverPicture(kKnownCovers + (number * 6 + i) % 24)));
  ObjectScene room;
  const double first = random.between(-0.02, 0.02);
  for (int i = 0; i < kKnownCovers; ++i) {
    const double z_m = random.between(0.9, 1.6), share = (i - 1) * 0.3 + first;  // of the view's width
    const Vec3d center(share * z_m * scene.width / scene.focal_px, random.between(-0.1, 0.1) * z_m, z_m);
    const int cover = (i + number) % kKnownCovers;
    scene.surfaces.push_back(
        panel(center, 0.12, 0.16, random.between(-35, 35), random.between(-20, 20), coverPicture(cover)));
    room.objects.push_back({cover, static_cast<int>(scene.surfaces.size()) - 1,
                            imageFromPicture(scene, scene.surfaces.back()), cv::norm(center)});
  }
  room.pair = render(scene, plainCamera(scene.seed));
  return room;
}

}  // namespace pomona
