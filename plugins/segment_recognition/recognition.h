// Objects recognised by their features, where a disparity map says that there is something near.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/matching.h"
#include "plugins/common/object_place.h"
#include "plugins/common/object_range.h"
#include "plugins/segment_recognition/regions.h"
#include "pomona/plugin.h"

namespace pomona {

/// Which features are compared with the database. Each filter includes the one before it.
enum class FeatureFilter {
  kNone,       ///< those of the left view that have a partner in the right one, whatever the geometry says
  kEpipolar,   ///< whose partner is near the epipolar line, and to the left
  kDisparity,  ///< found in the near regions of a disparity map
};

/// Where the disparity of a feature comes from.
enum class FeatureDisparity {
  kPartner,  ///< the feature of the right view that looks most like it
  kMap,      ///< the engine's dense map (kDisparity only): no features of the right view are needed
};

struct RecognitionOptions {
  FeatureFilter filter = FeatureFilter::kDisparity;
  FeatureDisparity disparity = FeatureDisparity::kMap;
  bool engine_map = true;  ///< regions by the engine's dense map, else by block matching
  RegionOptions regions;
  double sensitivity = 2;   ///< see FeatureFinder
  double pair_ratio = 0.8;  ///< of partners, see MatchOptions
  double max_epipolar_px = 1;
  LocateOptions locate;
  ObjectRanging ranging = ObjectRanging::kPlane;
};

/// What the filter has left of the left view's features, their points, and their nearest neighbours in the
/// database; all three in the same order.
struct ComparedFeatures {
  Features features;
  std::vector<SparsePoint> points;
  std::vector<ObjectMatch> matches;
  std::vector<SparseFigure> figures;
};

ComparedFeatures compareFeatures(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                                 const std::function<const StereoResult&()>& dense,
                                 const ObjectMatcher& matcher, const RecognitionOptions& options);

/// Looks for each object of the database and says where it is: one entry in `objects` each, found or not.
SparseResult recogniseObjects(const RectifiedPair& pair, const StereoCalibration& rig, const cv::Mat& mask,
                              const std::function<const StereoResult&()>& dense,
                              const ObjectDatabase& database, const RecognitionOptions& options);

}  // namespace pomona
