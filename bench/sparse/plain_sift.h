// What plain SIFT makes of a pair: what the plugins are compared with.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pomona/calibration.h"
#include "pomona/sparse_result.h"

namespace pomona {

struct PlainSiftOptions {
  float ratio = 0.8f;                                 ///< of Euclid's distances
  float max_row_offset_px = 3, min_disparity_px = 3;  ///< which matches count as verified
};

struct PlainSiftResult {
  int features_left = 0, features_right = 0;
  std::vector<SparsePoint> points;  ///< the verified matches
};

/// cv::SIFT with its defaults on both whole views, cv::BFMatcher (Euclid), the ratio, the constraints.
PlainSiftResult runPlainSift(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                             const PlainSiftOptions& options = {});

}  // namespace pomona
