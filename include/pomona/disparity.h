// The result of dense stereo matching: a disparity, a state and a confidence for every pixel.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

namespace pomona {

/// What a pixel of the disparity map is, and why. Values are stable: they are what `--state` writes.
enum class PixelState : std::uint8_t {
  kMeasured = 0,  ///< matched, and passed every check

  // Filled: a disparity is present, taken from somewhere else.
  kFilledBackground = 1,    ///< occluded; the background beside it was extended
  kFilledInterpolated = 2,  ///< rejected for another reason; interpolated from measured pixels around it
  kFilledCoarse = 3,        ///< nothing near supported a value; taken from the 1/4- and 1/5-scale maps

  // Missing: the disparity is NaN.
  kOccluded = 16,    ///< seen by the left camera only
  kMismatched = 17,  ///< left and right view disagree, but the point should be visible in both
  kAmbiguous = 18,   ///< a second disparity fits almost as well (low or repetitive texture)
  kSpeckle = 19,     ///< part of a region too small to be trusted
  kOutOfRange = 20,  ///< its match lies outside the right image
  kMasked = 21,      ///< excluded by the caller's mask
};

constexpr bool isMeasured(PixelState s) { return s == PixelState::kMeasured; }
constexpr bool isMissing(PixelState s) { return s >= PixelState::kOccluded; }
constexpr bool isFilled(PixelState s) { return !isMeasured(s) && !isMissing(s); }
/// A short lower-case word, e.g. "occluded"; "unknown" for a value outside the enumeration.
std::string_view name(PixelState state);

/// Wall-clock time one stage of the last frame took.
struct StageTiming {
  std::string_view stage;  ///< static text, e.g. "aggregation"
  double milliseconds;
};

/// All maps have the size of the left image, which is the reference view.
struct StereoResult {
  cv::Mat disparity;   ///< CV_32F, pixels of the given image, d = x_left - x_right; quiet NaN where unknown
  cv::Mat state;       ///< CV_8U, values of PixelState
  cv::Mat confidence;  ///< CV_32F in [0, 1]; 0 where the disparity is unknown
  std::vector<StageTiming> timings;  ///< in the order the stages ran

  PixelState stateAt(int y, int x) const { return static_cast<PixelState>(state.at<std::uint8_t>(y, x)); }
};

}  // namespace pomona
