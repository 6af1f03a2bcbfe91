// Features of the left view and their partners in the right one, along the rows of a rectified pair.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/object_features.h"

namespace pomona {

struct PairingOptions {
  double max_row_offset_px = 2;
  double min_disparity_px = 0, max_disparity_px = 1e9;
  double ratio = 0.8;  ///< of the best partner's distance to that of the next one elsewhere on the row
  bool mutual = true;  ///< the partner's own best partner must be the same feature
};

/// queryIdx counts in `left`, trainIdx in `right`. Only what the options allow is compared, which makes it
/// fast: a feature competes with the few on its rows, not with the whole view.
std::vector<cv::DMatch> pairFeatures(const Features& left, const Features& right,
                                     const PairingOptions& options);

}  // namespace pomona
