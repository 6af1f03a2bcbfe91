#include "plugins/segment_recognition/regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

cv::Mat square(int side) {
  return cv::getStructuringElement(cv::MORPH_RECT, {side, side});
}

void removeSmallRegions(cv::Mat& mask, int min_area_px) {
  cv::Mat labels, figures, centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, figures, centers);
  std::vector<std::uint8_t> keeps(count, 0);
  for (int i = 1; i < count; ++i) keeps[i] = figures.at<int>(i, cv::CC_STAT_AREA) >= min_area_px ? 255 : 0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) mask.at<std::uint8_t>(y, x) = keeps[labels.at<int>(y, x)];
}

}  // namespace

cv::Mat nearRegions(const cv::Mat& disparity, const StereoCalibration& rig, const RegionOptions& options) {
  const double least_px = rig.focal_px * rig.baseline_m / options.far_m - rig.doffs_px;
  cv::Mat regions = disparity >= least_px;  // false for NaN
  cv::morphologyEx(regions, regions, cv::MORPH_OPEN, square(options.opening_px));
  removeSmallRegions(regions, options.min_area_px);
  cv::dilate(regions, regions, square(2 * options.margin_px + 1));
  return regions;
}

cv::Mat regionsInRightView(const cv::Mat& regions, const cv::Mat& disparity, const RegionOptions& options) {
  cv::Mat right = cv::Mat::zeros(regions.size(), CV_8U);
  for (int y = 0; y < regions.rows; ++y)
    for (int x = 0; x < regions.cols; ++x) {
      const float d = disparity.at<float>(y, x);
      if (!regions.at<std::uint8_t>(y, x) || !std::isfinite(d)) continue;
      const int partner = x - cvRound(d);
      if (partner >= 0 && partner < right.cols) right.at<std::uint8_t>(y, partner) = 255;
    }
  cv::morphologyEx(right, right, cv::MORPH_CLOSE, square(options.opening_px));
  cv::dilate(right, right, square(2 * options.margin_px + 1));
  return right;
}

cv::Mat blockMatchingDisparity(const cv::Mat& left, const cv::Mat& right, int num_disparities) {
  constexpr int kBlock = 15, kStep = 16, kFractions = 16;
  const int disparities = (std::max(num_disparities, 1) + kStep - 1) / kStep * kStep;
  // StereoBM leaves a band of the searched width unmatched at the left: it gets one that is no image.
  cv::Mat wide_left, wide_right, fixed, map;
  cv::copyMakeBorder(left, wide_left, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, wide_right, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  cv::StereoBM::create(disparities, kBlock)->compute(wide_left, wide_right, fixed);
  fixed = fixed.colRange(disparities, fixed.cols);
  fixed.convertTo(map, CV_32F, 1.0 / kFractions);
  map.setTo(std::numeric_limits<float>::quiet_NaN(), fixed < 0);
  return map;
}

}  // namespace pomona
