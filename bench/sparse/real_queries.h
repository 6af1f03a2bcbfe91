// Things in real pairs, to be found again from altered pictures of them.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "pomona/calibration.h"

namespace pomona {

struct RealQuery {
  std::string scene;  ///< folder of a pair in Middlebury's layout
  std::string label;
  cv::Rect place;          ///< in the left view
  double scale, turn_deg;  ///< of the picture: as large as this, turned by that
  double gain, offset;     ///< on its gray values
};

/// Book covers, boxes and labels; none from scenes whose truth is known in steps of more than 2 % only.
const std::vector<RealQuery>& realQueries();

/// What a camera of another place and exposure might have taken of it: cut from the left view, scaled,
/// turned, brightened or darkened.
cv::Mat pictureOf(const RealQuery& query, const cv::Mat& left);

struct RealPair {
  cv::Mat left, right;
  StereoCalibration calibration;  ///< the scene's; where it has none, one with f = width and B = 0.1 m
  double truth_px = 0;            ///< median of the true disparities in the middle ninth of the place
};
/// From `folder`, or a folder below it, that is called query.scene; throws std::runtime_error if there is
/// none.
RealPair realPair(const RealQuery& query, const std::string& folder);

/// What a depth says about the disparity.
double disparityOf(const StereoCalibration& calibration, double z_m);

/// The median of the known disparities around `middle` (CV_32F, NaN unknown) in a ninth of an area of that
/// size.
double medianDisparity(const cv::Mat& disparity, const cv::Rect& place);

}  // namespace pomona
