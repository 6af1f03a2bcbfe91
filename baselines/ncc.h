// Normalised cross-correlation over a square window.
#pragma once

#include <opencv2/core.hpp>

#include "baselines/winner.h"

namespace pomona {

/// Cost: 1 - the correlation coefficient of the two windows, after the mean of each channel is taken off
/// (also called ZNCC); 0 to 2. Gain and offset between the views do not matter. A window without texture
/// correlates with nothing: cost 1. Arguments as for matchSsd().
WindowMaps matchNcc(const cv::Mat& left, const cv::Mat& right, int radius, SearchRange range,
                    WinnerPosition position, int threads);

}  // namespace pomona
