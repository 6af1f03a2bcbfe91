// Pairs with known disparities, and how far off ranged points are on them.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "pomona/calibration.h"
#include "pomona/sparse_result.h"

namespace pomona {

struct TruthPair {
  std::string name;
  cv::Mat left, right;
  cv::Mat truth;  ///< CV_32F disparities, NaN unknown
  StereoCalibration calibration;
};

/// Rendered rooms: 640 x 480, f 640 px, baseline 120 mm, a floor whose paint varies by 10, 14, 20 and 28 of
/// 256 grey levels in total, three of each; with a little blur and noise.
std::vector<TruthPair> indoorPairs();

/// The scenes below `folder`, or none if that is empty. What their calibration does not say is made up: it is
/// of no account for disparities.
std::vector<TruthPair> realPairs(const std::string& folder);

/// The true disparity at the pixel that holds `left_px`; NaN if unknown, or outside.
float truthAt(const cv::Mat& truth, cv::Point2f left_px);

/// Points where the truth is known, and how many of them are within a pixel of it.
struct PointAccuracy {
  int known = 0, right = 0;
  std::vector<float> errors_px;  ///< without sign

  void add(float disparity_px, float true_px);
  void add(const PointAccuracy& other);
  double percentRight() const { return known ? 100.0 * right / known : 0; }
  double medianPx() const;
};
PointAccuracy accuracyOf(const std::vector<SparsePoint>& points, const cv::Mat& truth);

/// The middle one; NaN if there is none.
double medianOf(std::vector<double> values);

}  // namespace pomona
