// Edges of all directions, and gray values that they are mixed with.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// The 3x3 Sobel masks for gradients towards 0, 45, 90 and 135 degrees (counter-clockwise from +X, y up):
///
///     0: -1 0 1    45:  0  1 2    90:  1  2  1    135:  2  1  0
///        -2 0 2        -1  0 1         0  0  0          1  0 -1
///        -1 0 1        -2 -1 0        -1 -2 -1          0 -1 -2
///
/// Each is the one before, turned by 45 degrees; their values add up to 0, so that even areas give 0.
/// `direction`: 0..3. CV_32F.
cv::Mat sobelMask(int direction);

/// The infinity norm of the four gradients, max |g_k| / 4: CV_8U, 255 at a step from black to white along an
/// axis. `gray`: CV_8UC1. Beyond the border, the nearest pixel.
cv::Mat edgeStrength(const cv::Mat& gray);

/// (1 - weight) gray + weight edges, `weight` in 0..1. CV_8U.
cv::Mat fusedWithEdges(const cv::Mat& gray, double weight);

}  // namespace pomona
