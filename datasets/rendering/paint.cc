#include "datasets/rendering/paint.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "datasets/rendering/noise.h"
#include "datasets/rendering/picture_paint.h"

namespace pomona {
namespace {

using cv::Vec3d;

Vec3d mixed(const Vec3d& first, const Vec3d& second, double share) {
  return first + (second - first) * std::clamp(share, 0.0, 1.0);
}

// 0 below `low`, 1 above `high`, smooth between.
double ramp(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// How much of a detail of this size a pixel of that size still shows.
double shown(double detail_m, double pixel_m) {
  return ramp(1, 2, detail_m / pixel_m);
}

// -1..1, mostly within +-0.6. `p` counts in cells of the coarsest octave, `cell_m` wide.
double fractal(Vec3d p, std::uint64_t seed, int octaves, double cell_m, double pixel_m) {
  constexpr double kGain = 0.8;  // each octave's amplitude relative to the one before: rich in fine detail
  double sum = 0, weight = 1, total = 0;
  for (int octave = 0; octave < octaves; ++octave, weight *= kGain, p *= 2, cell_m /= 2) {
    total += weight;
    const double visible = shown(cell_m, pixel_m);
    if (visible > 0) sum += weight * visible * (2 * valueNoise(p, seed + octave) - 1);
  }
  return 1.8 * sum / total;  // the sum of octaves seldom leaves a half of its range
}

double mottle(const Solid& s, const Vec3d& point, double pixel_m, int octaves = 4) {
  return fractal((point - s.center) * (1 / s.paint.cell_m), s.seed, octaves, s.paint.cell_m, pixel_m);
}

Vec3d plainNoise(const Solid& s, const Vec3d& point) {
  constexpr int kOctaves = 3;
  constexpr double kGain = 0.8;
  Vec3d p = (point - s.center) * (1 / s.paint.cell_m);
  double sum = 0, weight = 1, total = 0;
  for (int octave = 0; octave < kOctaves; ++octave, weight *= kGain, p *= 2) {
    sum += weight * (valueNoise(p, s.seed + octave) - 0.5);
    total += weight;
  }
  return mixed(s.paint.first_bgr, s.paint.second_bgr, 0.5 + 1.8 * sum / total);
}

// first_bgr: the ground colour; second_bgr: the blush over it, in streaks along the meridians.
Vec3d fruit(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  const double streak_m = 0.16 * s.half_width_m;
  const double streaks = fractal({p[0] * 6, p[1] * 6, p[2] * 0.9}, s.seed, 3, streak_m, pixel_m);
  const double clouds = fractal(p * 1.3, s.seed + 10, 2, 0.8 * s.half_width_m, pixel_m);
  Vec3d color = mixed(s.paint.first_bgr, s.paint.second_bgr, 0.62 + 0.75 * clouds + 0.45 * streaks);
  const double grain = mottle(s, point, pixel_m, 2);
  const double dots = ramp(0.74, 0.86, valueNoise(p * 9, s.seed + 20)) * shown(streak_m * 0.5, pixel_m);
  const double stalk = ramp(0.86, 1, p[2]);  // the hollow at the top
  color = mixed(color * (1 + 0.16 * grain), Vec3d(150, 205, 225), 0.45 * dots);
  return color * (1 - 0.55 * stalk);
}

Vec3d foliage(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  const double from_rib_m = std::abs(p[1]) * s.half_width_m;
  const double tone = 0.45 + 0.5 * mottle(s, point, pixel_m);
  Vec3d color = mixed(s.paint.first_bgr, s.paint.second_bgr, tone);
  const Vec3d pale = s.paint.second_bgr * 1.15 + Vec3d(18, 22, 18);
  // Side veins leave the midrib slanting towards the tip, seven on each side.
  const double along = (p[0] - 0.5 * std::abs(p[1])) * 3.5;
  const double to_vein = std::abs(along - std::floor(along) - 0.5) / 3.5 * s.half_length_m;
  constexpr double kRib_m = 0.0011, kVein_m = 0.0007;
  const double rib = 1 - ramp(0.5 * kRib_m, 1.4 * kRib_m, from_rib_m);
  const double vein = (1 - ramp(0.4 * kVein_m, 1.6 * kVein_m, to_vein)) * shown(2 * kVein_m, pixel_m);
  return mixed(color, pale, std::max(0.75 * rib, 0.35 * vein));
}

Vec3d bark(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  const double cell_m = s.paint.cell_m;
  const double around = s.radiusM() / cell_m, along = 0.3 * s.half_width_m / cell_m;
  const double ridges = fractal({p[0] * around, p[1] * around, p[2] * along}, s.seed, 3, cell_m, pixel_m);
  return mixed(s.paint.first_bgr, s.paint.second_bgr,
               0.45 + 0.5 * ridges + 0.25 * mottle(s, point, pixel_m, 3));
}

Vec3d brick(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  const double height_m = s.paint.cell_m / 3;
  const double y = p[1] * s.half_width_m / height_m, course = std::floor(y);
  const double x = p[0] * s.half_length_m / s.paint.cell_m + 0.5 * (course - 2 * std::floor(course / 2));
  const double column = std::floor(x);
  const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(column * 8191 + course));
  const double shade = unitInterval(hash(s.seed + number));
  const double from_joint_m = std::min(std::min(x - column, column + 1 - x) * s.paint.cell_m,
                                       std::min(y - course, course + 1 - y) * height_m);
  const double joint = 1 - ramp(0.06 * height_m, 0.12 * height_m, from_joint_m);
  const double grain =
      fractal((point - s.center) * (4 / s.paint.cell_m), s.seed, 4, s.paint.cell_m / 4, pixel_m);
  const Vec3d face = mixed(s.paint.first_bgr, s.paint.second_bgr, shade) * (1 + 0.22 * grain);
  return mixed(face, Vec3d(150, 160, 165) * (1 + 0.15 * grain), joint);
}

// The emblem at the left end of a sign, -1..1 in both directions: a ring, and within it a figure of as many
// corners as the seed says, cut into fields.
bool isInEmblem(double x, double y, std::uint64_t seed) {
  const double r2 = x * x + y * y;
  if (r2 > 0.81) return false;
  if (r2 > 0.6) return true;
  const double cut = unitInterval(hash(seed + 1)) - 0.5, slope = 1.6 * unitInterval(hash(seed + 2)) - 0.8;
  const bool upper = y > slope * x + 0.4 * cut, right = x > -slope * y - 0.4 * cut;
  const bool inner = std::abs(x) + std::abs(y) < 0.3 + 0.25 * unitInterval(hash(seed + 3));
  return (upper == right) != inner;
}

Vec3d sign(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  const double x_m = p[0] * s.half_length_m, y_m = p[1] * s.half_width_m, half_m = s.half_width_m;
  const double from_edge_m = std::min(s.half_length_m - std::abs(x_m), half_m - std::abs(y_m));
  const double emblem_x = (x_m + s.half_length_m - 1.1 * half_m) / (0.8 * half_m),
               emblem_y = y_m / (0.8 * half_m);
  const double text_left_m = -s.half_length_m + 2.1 * half_m, text_right_m = s.half_length_m - 0.35 * half_m;
  const double text_x = (x_m - text_left_m) / (text_right_m - text_left_m),
               text_y = y_m / (1.1 * half_m) + 0.5;
  const bool frame = from_edge_m > 0.06 * half_m && from_edge_m < 0.13 * half_m;
  const bool ink = frame || isInEmblem(emblem_x, emblem_y, s.seed) || isInText(s.paint.text, text_x, text_y);
  const double grain = fractal((point - s.center) * (1 / s.paint.cell_m), s.seed, 4, s.paint.cell_m, pixel_m);
  return (ink ? s.paint.second_bgr : s.paint.first_bgr) * (1 + 0.1 * grain);
}

Vec3d picture(const Solid& s, const Vec3d& point, double pixel_m) {
  const Vec3d p = s.localAt(point);
  return pictureAt(s.reductions, (p[0] + 1) / 2, (p[1] + 1) / 2, pixel_m / (2 * s.half_length_m));
}

}  // namespace

Vec3d paintAt(const Solid& solid, const Vec3d& point, double pixel_m) {
  switch (solid.paint.pattern) {
    case Pattern::kNoise:
      return plainNoise(solid, point);
    case Pattern::kMottle:
      return mixed(solid.paint.first_bgr, solid.paint.second_bgr, 0.5 + 0.5 * mottle(solid, point, pixel_m));
    case Pattern::kFruit:
      return fruit(solid, point, pixel_m);
    case Pattern::kFoliage:
      return foliage(solid, point, pixel_m);
    case Pattern::kBark:
      return bark(solid, point, pixel_m);
    case Pattern::kBrick:
      return brick(solid, point, pixel_m);
    case Pattern::kSign:
      return sign(solid, point, pixel_m);
    case Pattern::kPicture:
      return picture(solid, point, pixel_m);
  }
  return {};
}

}  // namespace pomona
