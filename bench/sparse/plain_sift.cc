#include "bench/sparse/plain_sift.h"

#include <cmath>
#include <opencv2/features2d.hpp>

#include "plugins/common/sift.h"
#include "plugins/common/triangulation.h"

namespace pomona {

PlainSiftResult runPlainSift(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                             const PlainSiftOptions& options) {
  const auto sift = cv::SIFT::create();
  std::vector<cv::KeyPoint> left_keypoints, right_keypoints;
  cv::Mat left_descriptors, right_descriptors;
  sift->detectAndCompute(grayOf(left), {}, left_keypoints, left_descriptors);
  sift->detectAndCompute(grayOf(right), {}, right_keypoints, right_descriptors);
  PlainSiftResult result{
      static_cast<int>(left_keypoints.size()), static_cast<int>(right_keypoints.size()), {}};
  if (left_keypoints.empty() || right_keypoints.empty()) return result;

  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_L2).knnMatch(left_descriptors, right_descriptors, nearest, 2);
  for (const auto& two : nearest) {
    if (two.size() < 2 || two[0].distance >= options.ratio * two[1].distance) continue;
    const cv::Point2f l = left_keypoints[static_cast<std::size_t>(two[0].queryIdx)].pt;
    const cv::Point2f r = right_keypoints[static_cast<std::size_t>(two[0].trainIdx)].pt;
    if (std::abs(l.y - r.y) > options.max_row_offset_px || l.x - r.x < options.min_disparity_px) continue;
    constexpr float kUsualSigma_px = 0.5f;
    result.points.push_back(triangulate(calibration, l, r, kUsualSigma_px));
  }
  return result;
}

}  // namespace pomona
