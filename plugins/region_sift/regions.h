// The regions of interest of a robot's view: seven sub-images that form six regions, some of which overlap.
//
//     +-------------------+
//     |         0         |   far strip: 0
//     +------+-----+------+   columns:   1 4, 2 5, 3 6
//     |  1   |  2  |  3   |   near strip: 4 5 6
//     +------+-----+------+   whole:     all
//     |  4   |  5  |  6   |
//     +------+-----+------+
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/sift.h"

namespace pomona {

struct RegionOptions {
  double far_share = 1.0 / 3;                     ///< of the height, 0..0.9; the rest is cut in halves
  bool far_region = false, whole_region = false;  ///< beside the three columns and the near strip
  /// One pass over all that the regions cover, instead of one for each.
  bool joined = false;
  bool equalise = true;  ///< the histogram of each region (of all, if joined)
  /// Of the picture that SIFT works on to the view, 0.25..1. SIFT begins by doubling its picture; most of its
  /// time goes into that, and few of the keypoints it gains are found again where there is little texture.
  double scale = 1;
  SiftOptions sift;
};

/// Left, middle and right column, near strip, and far strip and whole if they are wanted; or the one that
/// covers them. Empty ones are left out.
std::vector<cv::Rect> regionsOf(cv::Size view, const RegionOptions& options);

/// SIFT, region by region. Of keypoints that overlapping regions both have (within half a pixel, of nearly
/// one size and orientation) that of the stronger response stays. `gray`: CV_8UC1; `mask` as in
/// siftFeatures().
ViewFeatures regionFeatures(const cv::Mat& gray, const cv::Mat& mask, const RegionOptions& options);

}  // namespace pomona
