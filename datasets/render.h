// A small deterministic ray caster: surfaces with procedural paint seen by a rectified stereo pair, with
// exact disparities and visibility. For tests with known answers, and for pictures when no real pair is at
// hand. docs/rendering.md states the model.
//
// Coordinates are metres in the left camera's frame: X right, Y down, Z forward. The right camera stands
// baseline_m along +X. Pixel (x, y) is the ray through its centre. The same description gives the same bytes
// on every machine and for any number of threads: integer hashes, and IEEE operations only (+ - * / sqrt).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "datasets/rendering/camera_effects.h"
#include "pomona/calibration.h"
#include "pomona/rig.h"

namespace pomona {

enum class Shape {
  kPlane,          ///< unbounded, through `center`, spanned by `u` and `v`
  kParallelogram,  ///< center + a u + b v with |a|, |b| <= 1
  kEllipse,        ///< center + a u + b v with a^2 + b^2 <= 1
  kSphere,         ///< around `center`
  kSpheroid,       ///< around `center`: half axis `v`, and radius_m at right angles to it
  kBranch,         ///< a cone without its ends, from center - v to center + v; its radius falls from
                   ///< radius_m (1 + taper) to radius_m (1 - taper)
  kLeaf,           ///< center + a u + b v + n (bend_u_m a^2 + bend_v_m b^2), n the normal: an oval with
                   ///< a pointed end at a = 1 and a rounder one at a = -1. u and v at right angles.
};

/// What the paint shows between its two colours, fixed to the surface: both views see the same.
enum class Pattern {
  kNoise,   ///< three octaves of value noise, all of them at any distance
  kMottle,  ///< four octaves of value noise; like all patterns below, without what is too fine for the pixels
  kFruit,   ///< kSpheroid: streaks from pole to pole, a blush, pale dots
  kFoliage,  ///< kLeaf: a midrib, side veins, mottled
  kBark,     ///< kBranch: noise drawn out along the axis
  kBrick,    ///< kParallelogram: courses of bricks of cell_m by cell_m / 3
  kSign,     ///< kParallelogram: a frame, a round emblem and `text`
  kPicture,  ///< kParallelogram: `picture`, its upper left corner at a = b = -1
};

struct Paint {
  cv::Vec3d first_bgr;  ///< 0..255
  cv::Vec3d second_bgr;
  double cell_m = 0.1;  ///< cells of the coarsest octave (at least 1e-6); each further one has half of that
  Pattern pattern = Pattern::kNoise;
  std::string text = {};  ///< kSign: capital letters
  cv::Mat picture = {};   ///< kPicture: CV_8UC3
};

struct Surface {
  Shape shape = Shape::kPlane;
  cv::Vec3d center;
  cv::Vec3d u, v;       ///< of the flat shapes and kLeaf: must not be parallel
  double radius_m = 0;  ///< kSphere, kSpheroid, kBranch
  Paint paint;
  double bend_u_m = 0, bend_v_m = 0;  ///< kLeaf
  double taper = 0;                   ///< kBranch: -1..1
};

/// A camera in the place of an ideal one.
struct PictureCamera {
  CameraModel model;                          ///< its size is that of the scene, whatever it says
  cv::Matx33d rotation = cv::Matx33d::eye();  ///< the ideal camera's frame from this one's
};

struct SceneDescription {
  int width = 0, height = 0;
  double focal_px = 0;
  double baseline_m = 0;
  int num_disparities = 0;  ///< all disparities lie in [0, num_disparities)
  std::uint64_t seed = 0;   ///< of the paint
  int channels = 3;         ///< 3 (BGR) or 1 (gray)
  int bits = 8;             ///< 8 or 16
  std::vector<Surface> surfaces;

  std::optional<cv::Vec2d> principal_px = {};  ///< of the left view; without one, the image's centre
  double doffs_px = 0;                         ///< the right view's cx minus the left one's
  /// The cameras that take the pictures, where these are not the ideal ones above: lenses that distort, axes
  /// that are off. Disparities and masks are those of the ideal pair even so.
  std::optional<PictureCamera> left_camera = {}, right_camera = {};
  bool sun = false;  ///< surfaces are lit by sun and sky, and throw shadows; else spheres alone are shaded
};

/// The principal point of the left view.
cv::Vec2d principalOf(const SceneDescription& scene);

struct RenderedView {
  cv::Mat image;      ///< CV_8U or CV_16U, 3 or 1 channels; the mean of 4x4 rays per pixel
  cv::Mat disparity;  ///< CV_32F, d = x_left - x_right of the surface at the pixel's centre; NaN where there
                      ///< is none
  cv::Mat mask;     ///< CV_8U: 255 the other view sees that surface point too, 128 it does not, 0 no surface
  cv::Mat surface;  ///< CV_32S: which of SceneDescription::surfaces the pixel's centre shows; -1 none
};

struct RenderedPair {
  RenderedView left, right;
  StereoCalibration calibration;
};

/// `threads`: 0 stands for all available. Throws std::invalid_argument naming the field for a description or
/// effects that cannot be rendered.
RenderedPair render(const SceneDescription& scene, const CameraEffects& effects = {}, int threads = 0);

/// How many pixels the surface would cover in the left view, its edges included, were nothing before it; only
/// for surfaces in front of the camera.
struct Outline {
  int pixels = 0;
  cv::Rect box_px;  ///< of those pixels
};
Outline outlineOf(const SceneDescription& scene, int surface);

}  // namespace pomona
