// The fruits of a frame, each once, and where they are.
#pragma once

#include <pomona/measure.h>

#include <opencv2/core.hpp>
#include <vector>

struct Pick {
  cv::Rect box;  // of the whole fruit, once measured; of what was seen, until then
  pomona::ObjectMeasurement where;
};

/// Measured fruits first, nearest first. `bgr` is the left view that `result` belongs to.
std::vector<Pick> pickingList(const pomona::StereoResult& result,
                              const pomona::StereoCalibration& calibration, const cv::Mat& bgr);
