// Where known signs are, how far away, and in which direction.
#pragma once

#include <opencv2/core.hpp>

#include "plugins/common/object_place.h"
#include "plugins/common/object_range.h"
#include "pomona/plugin.h"

namespace pomona {

struct LogoRangeOptions {
  double sensitivity = 2;   ///< of the features in the views, see FeatureFinder
  bool upper_half = false;  ///< look for signs in the upper half of the left view only
  LocateOptions locate;
  double pair_ratio = 0.85;  ///< see MatchOptions
  double max_row_offset_px = 2;
  ObjectRanging ranging = ObjectRanging::kPlane;
};

/// Looks for each object of `database` and ranges what it finds: one entry in `objects` each, found or not,
/// and the points of the features that were seen in both views. `mask`: empty, or where to look.
SparseResult rangeSigns(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                        const ObjectDatabase& database, const LogoRangeOptions& options);

}  // namespace pomona
