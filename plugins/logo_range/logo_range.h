// Where known signs are, how far away, and in which direction.
#pragma once

#include <opencv2/core.hpp>

#include "plugins/common/object_match.h"
#include "pomona/plugin.h"

namespace pomona {

enum class SignRanging {
  /// The mean of the matched features' points, without those whose depth is off the mean by more than one
  /// standard deviation.
  kFeatureMean,
  /// The middle of the sign on the plane that aligns the views (alignDisparityPlane()).
  kAlignedPlane,
};

struct LogoRangeOptions {
  double sensitivity = 2;   ///< of the features in the views, see FeatureFinder
  bool upper_half = false;  ///< look for signs in the upper half of the left view only
  LocateOptions locate;
  double pair_ratio = 0.85;  ///< see MatchOptions
  double max_row_offset_px = 2;
  SignRanging ranging = SignRanging::kAlignedPlane;
};

/// Looks for each object of `database` and ranges what it finds: one entry in `objects` each, found or not,
/// and the points of the features that were seen in both views. `mask`: empty, or where to look.
SparseResult rangeSigns(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                        const ObjectDatabase& database, const LogoRangeOptions& options);

}  // namespace pomona
