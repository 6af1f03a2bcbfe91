// Pictures of disparity, state, confidence and error maps, for people. All are CV_8UC3 (BGR) unless stated.
#pragma once

#include <opencv2/core.hpp>

#include "pomona/disparity.h"

namespace pomona {

struct DisparityRange {
  float low, high;  ///< low < high
};

/// The range of the known disparities in `disparity` (CV_32F) without the extreme 1 % at either end; {0, 1}
/// if none is known. At least one pixel wide.
DisparityRange typicalRange(const cv::Mat& disparity);

/// Far (range.low and below) is dark blue; over cyan, green and yellow it warms to dark red (range.high and
/// above, near). Unknown (NaN) is black.
cv::Mat colorizeDisparity(const cv::Mat& disparity, DisparityRange range);

/// The colour a state has in colorizeStates: measured light gray; filled from the background green,
/// interpolated light green, from the coarse maps turquoise, from a plane pale turquoise; occluded blue,
/// mismatched red, ambiguous yellow, speckle magenta, out of range orange, masked black. White for a value
/// outside the enumeration.
cv::Vec3b stateColor(PixelState state);
cv::Mat colorizeStates(const cv::Mat& states);

/// CV_8UC1: 0 for confidence 0 (or NaN) to 255 for 1.
cv::Mat confidenceToGray(const cv::Mat& confidence);

/// |disparity - ground_truth|: dark green at 0, over yellow to red at `limit_px` and above. Unknown ground
/// truth is black; a hole in `disparity` is white. Both CV_32F with NaN for unknown, of equal size.
cv::Mat colorizeError(const cv::Mat& disparity, const cv::Mat& ground_truth, float limit_px = 4);

}  // namespace pomona
