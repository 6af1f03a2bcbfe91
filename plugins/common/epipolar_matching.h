// Matching keypoints of a rectified pair, whose rows and disparities say which may belong together.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

namespace pomona {

/// Keypoints of one view, and a row of CV_8U descriptor for each.
struct ViewFeatures {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

/// What two keypoints of one point have in common.
struct EpipolarConstraints {
  float max_row_offset_px = 3;
  /// Of x_left - x_right.
  float min_disparity_px = 3, max_disparity_px = 1e9f;
  float max_size_ratio = 1e9f;  ///< of the larger keypoint's size to the smaller's, >= 1
  float max_turn_deg = 180;     ///< difference of their orientations

  bool allow(const cv::KeyPoint& left, const cv::KeyPoint& right) const;
};

/// Rows of the two lists of keypoints.
struct FeatureMatch {
  int left = -1, right = -1;
};

struct MatchingOptions {
  EpipolarConstraints constraints;
  float ratio = 0.7f;   ///< nearest to second nearest distance (combined_distance.h) has to be below this
  bool mutual = false;  ///< the left keypoint must also be the nearest of the right one
};

/// Matches as they are published: nearest and second nearest of all keypoints, the ratio, and only then the
/// constraints. In the order of the left keypoints.
std::vector<FeatureMatch> matchAll(const ViewFeatures& left, const ViewFeatures& right,
                                   const MatchingOptions& options);

/// Matches among those that the constraints allow: a keypoint competes with the few others along its row and
/// not with all of the image, so more of them pass the ratio. A second nearest within two pixels of the
/// nearest is the same point found twice, and does not count.
std::vector<FeatureMatch> matchAlongRows(const ViewFeatures& left, const ViewFeatures& right,
                                         const MatchingOptions& options);

}  // namespace pomona
