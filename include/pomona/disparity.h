// The result of dense stereo matching: a disparity, a state and a confidence for every pixel.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "pomona/pixel_state.h"

namespace pomona {

/// Wall-clock time one stage of the last frame took.
struct StageTiming {
  std::string_view stage;  ///< static text, e.g. "aggregation"
  double milliseconds;
};

/// All maps have the size of the left image, which is the reference view.
struct StereoResult {
  cv::Mat disparity;  ///< CV_32F, pixels of the given image, d = x_left - x_right; quiet NaN where unknown
  cv::Mat state;      ///< CV_8U, values of PixelState
  /// CV_32F in [0, 1]: the probability that the disparity is right to within a pixel, as rendered scenes have
  /// it (bench/confidence); 0 where it is unknown.
  cv::Mat confidence;
  /// CV_32F, pixels: the disparities of 68.3 % of pixels like this one are off by at most this, as with one
  /// sigma of a normal distribution; NaN where the disparity is unknown. Filled pixels have larger ones.
  cv::Mat sigma_px;
  /// Vertical offset y_right - y_left between the views, which should be 0: median over some hundred points,
  /// and the largest anywhere in the image, signless. Beyond 0.5 px the camera wants a new calibration. NaN
  /// where Options::row_check is off or too few points could be matched.
  float row_offset_px = std::numeric_limits<float>::quiet_NaN();
  float row_error_px = std::numeric_limits<float>::quiet_NaN();
  /// Whether the right view was moved by that offset before it was matched (Options::align_rows).
  bool rows_aligned = false;
  std::vector<StageTiming> timings;  ///< in the order the stages ran

  /// Whether the rows, as they came, do not match: the rig wants a new calibration, even if `rows_aligned`.
  bool rowsAreOff() const { return std::abs(row_offset_px) > 0.5f || row_error_px > 1.0f; }
  PixelState stateAt(int y, int x) const { return static_cast<PixelState>(state.at<std::uint8_t>(y, x)); }
};

}  // namespace pomona
