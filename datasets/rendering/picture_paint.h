// Pictures on surfaces.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace pomona {

/// `picture` (CV_8UC3), and its means over 2 x 2, 4 x 4, ... pixels, down to a side of one.
std::vector<cv::Mat> reductionsOf(const cv::Mat& picture);

/// The picture at (x, y), 0..1 from its upper left corner, between pixels in proportion; from the finest of
/// its reductions whose pixels are at least half as wide as `pixel`, the side of a camera's pixel in units of
/// the picture's width: rays that are a quarter of a pixel apart then miss none.
cv::Vec3d pictureAt(const std::vector<cv::Mat>& reductions, double x, double y, double pixel);

}  // namespace pomona
