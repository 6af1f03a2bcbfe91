// Are the views of a pair aligned row by row? Matching along rows fails silently where they are not.
#pragma once

#include <cstdint>

#include "camera/kernels.h"
#include "core/image.h"

namespace pomona {

/// y_right - y_left, as it varies over the image.
struct RowOffsetPlane {
  float center_px, slope_x_px, slope_y_px;  ///< in the middle; from there to the right and the lower border

  double at(double x, double y, int width, int height) const {
    return center_px + slope_x_px * (2 * x / width - 1) + slope_y_px * (2 * y / height - 1);
  }
};

struct RowOffsets {
  /// Median of y_right - y_left over the points within 1 px of the plane, positive where the right view shows
  /// things lower: repeated patterns make matches that are off, and disagree. NaN if fewer than 10 points
  /// could be matched, or fewer than 5 of them agree.
  float median_px;
  /// The largest |y_right - y_left| in any corner of the image, by a plane fitted to the points: notices a
  /// camera that is turned, too. NaN where median_px is.
  float worst_px;
  int points;  ///< that were matched, at most 160
  RowOffsetPlane plane;
  float scatter_px;  ///< median distance of the points from the plane; NaN where median_px is
};

inline constexpr int kFewestRowPoints = 10;  ///< that tell how rows lie

/// Whether two measurements of one pair, as it was given and with its views exchanged, say that the views
/// were exchanged: then partners are found the other way round. (Points of things far away are found both
/// ways.)
constexpr bool seemExchanged(const RowOffsets& as_given, const RowOffsets& exchanged) {
  return exchanged.points >= kFewestRowPoints && exchanged.points > 2 * as_given.points + 5;
}

/// Matches up to 160 well-textured points of the left view in two dimensions: by sums of absolute differences
/// in views reduced to a quarter (a half below 800 px of width, not at all below 400), then by Lucas &
/// Kanade's method (1981) there and at full size; where fewer than 10 points match in views reduced to a
/// quarter, once more in halves. Where they disagree, or their rows seem to lie halfway between each other's
/// in the reduced views, once more with the right view reduced half a row lower: that result is taken if it
/// has half again as many points. The result does not depend on the number of threads. Keeps its memory
/// between frames.
class RowCheck {
 public:
  /// `left`, `right`: gray, of equal size. Disparities are looked for from `min_disparity` on,
  /// `num_disparities` of them, and rows up to `reach_px` up and down; the time grows with both.
  RowOffsets measure(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                     int min_disparity, int num_disparities, const CameraKernels& kernels, int threads,
                     int reach_px = 8);

 private:
  struct View {
    Image<std::uint8_t> coarse;  // mean of scale x scale pixels
    Image<std::uint8_t>
        contrast;  // 128 + what stands out from its surroundings, for matching across exposures
  };
  static void reduce(ImageView<const std::uint8_t> in, int scale, int lower, View& view,
                     const CameraKernels& kernels, int threads);

  View left_, right_;
};

}  // namespace pomona
