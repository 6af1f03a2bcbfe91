// Which keypoints of two views look alike.
#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace pomona {

enum class DescriptorDistance {
  kEuclidean,
  kCityblock,   ///< sum of the differences
  kChessboard,  ///< largest difference
  kCombined,    ///< half of the one plus half of the other
};

struct MatchOptions {
  DescriptorDistance distance = DescriptorDistance::kEuclidean;
  /// A match must be nearer than this share of the distance to the second nearest candidate; 1: no test.
  float ratio = 0.8f;
  bool mutual = true;  ///< each must be the other's nearest candidate
  float max_distance = std::numeric_limits<float>::infinity();
  int threads = 0;  ///< 0: all available
};

struct KeypointMatch {
  int left = 0, right = 0;  ///< indices
  float distance = 0;
  float ratio = 0;  ///< distance / that of the second nearest candidate; 0 if there is no other
};

/// Where the partner of a left keypoint may be.
struct RowBand {
  static constexpr float kAny = std::numeric_limits<float>::infinity();

  float max_row_offset_px = kAny;                           ///< |y_left - y_right| at most
  float min_disparity_px = -kAny, max_disparity_px = kAny;  ///< ends included
  bool allows(cv::Point2f left_px, cv::Point2f right_px) const;
};

/// The nearest right descriptor of each left one, in the order of the left ones, among those that `band`
/// allows: only those are compared, so a narrow band is fast, and its ratios are those of its candidates.
/// `left` and `right`: one descriptor per row, CV_8U or CV_32F, of one type and length; CV_8U is faster. The
/// keypoints belong to them; where the band allows everything, they may be left out. Of two equally near
/// candidates neither is taken. The same for any number of threads. Throws std::invalid_argument for what
/// does not fit together.
std::vector<KeypointMatch> matchKeypoints(const cv::Mat& left, const cv::Mat& right,
                                          const MatchOptions& options = {}, const RowBand& band = {},
                                          std::span<const cv::KeyPoint> left_keypoints = {},
                                          std::span<const cv::KeyPoint> right_keypoints = {});

/// Descriptors rounded to CV_8U after multiplication by `scale`, cut off at 0 and 255. OpenCV's SIFT has
/// whole numbers below 256, so that scale 1 changes nothing.
cv::Mat descriptorsToBytes(const cv::Mat& descriptors, double scale = 1);

}  // namespace pomona
