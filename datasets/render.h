// A small deterministic ray caster: textured planes, parallelograms and spheres seen by a rectified stereo
// pair, with exact disparities and visibility. For tests with known answers, and for a picture when no real
// pair is at hand.
//
// Coordinates are metres in the left camera's frame: X right, Y down, Z forward. The right camera stands
// baseline_m along +X. Pixel (x, y) is the ray through its centre; the principal point is the image centre in
// both views. The same description gives the same bytes on every machine: integer hashes, and IEEE operations
// only (+ - * / sqrt).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "pomona/calibration.h"

namespace pomona {

enum class Shape {
  kPlane,          ///< unbounded, through `center`, spanned by `u` and `v`
  kParallelogram,  ///< center + a u + b v with |a|, |b| <= 1
  kSphere,         ///< around `center`
};

/// Value noise between two colours, fixed to the surface: both views see the same paint. Three octaves; the
/// coarsest has cells of `cell_m`, each further one half of that.
struct Paint {
  cv::Vec3d first_bgr;  ///< 0..255
  cv::Vec3d second_bgr;
  double cell_m = 0.1;
};

struct Surface {
  Shape shape = Shape::kPlane;
  cv::Vec3d center;
  cv::Vec3d u, v;       ///< kPlane, kParallelogram: must not be parallel
  double radius_m = 0;  ///< kSphere
  Paint paint;
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
};

struct RenderedView {
  cv::Mat image;      ///< CV_8U or CV_16U, 3 or 1 channels; the mean of 4x4 rays per pixel
  cv::Mat disparity;  ///< CV_32F, d = x_left - x_right of the surface at the pixel's centre; NaN where there
                      ///< is none
  cv::Mat mask;  ///< CV_8U: 255 the other view sees that surface point too, 128 it does not, 0 no surface
};

struct RenderedPair {
  RenderedView left, right;
  StereoCalibration calibration;
};

/// Throws std::invalid_argument naming the field for a description that cannot be rendered.
RenderedPair render(const SceneDescription& scene);

}  // namespace pomona
