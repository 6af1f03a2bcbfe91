// The result of dense stereo matching: a disparity, a state and a confidence for every pixel.
#pragma once

#include <cstdint>
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
  /// CV_32F, pixels: the standard deviation of the disparity if it is right to within a pixel; NaN where it
  /// is unknown. Filled pixels have larger ones than measured pixels.
  cv::Mat sigma_px;
  std::vector<StageTiming> timings;  ///< in the order the stages ran

  PixelState stateAt(int y, int x) const { return static_cast<PixelState>(state.at<std::uint8_t>(y, x)); }
};

}  // namespace pomona
