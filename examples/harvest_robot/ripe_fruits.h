// Where ripe fruits may be, by their colour and shape: stands in for a trained detector.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

using Contour = std::vector<cv::Point>;

/// Outlines of what has the colour of ripe fruits, cut where touching fruits meet. A fruit that leaves divide
/// may have several.
std::vector<Contour> ripeOutlines(const cv::Mat& bgr);
