// One method on one scene: the map, how wrong it is, and how long it took.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "baselines/method.h"
#include "datasets/scene.h"
#include "pomona/evaluation.h"

namespace pomona {

/// What is counted over one set of pixels.
struct RegionFigures {
  DisparityErrors errors;
  CoverageCurve curve;  ///< wrong by more than 1 px; without points if the method has no confidence
  SubpixelErrors subpixel;
  std::optional<KittiErrors> kitti;  ///< KITTI's scenes only; of the filled map, as the benchmark counts
};

struct Measurement {
  std::string scene, method;
  cv::Size size;
  int num_disparities = 0;
  double milliseconds = 0;
  /// Without truth, neither is there; without a mask of the non-occluded pixels, only `all`.
  std::optional<RegionFigures> all, nonoccluded;
};

/// How many disparities, from 0 up, every method is to search, so that none has to guess: the data set's own
/// bound if it states one for the scene (a manifest's max_disparity); else disparitiesToReach() the truth;
/// without truth ndisp of the calibration; and without that an estimate. At most the width, and 1024.
int disparitiesToSearch(const SceneFiles& files, const Scene& scene);

/// Runs the method; if that took less than kWarmUpLimit_ms, once more, and the second run's time counts: the
/// first one makes the threads and buffers that a stream of pairs would find made.
MethodResult runTimed(Method& method, const Scene& scene, const MethodOptions& options);
inline constexpr double kWarmUpLimit_ms = 2000;

/// Scores `result` by the rules of the scene's benchmark: for Middlebury, known disparities are clipped to
/// [0, ndisp] where the calibration states ndisp, and compared as whole pixels if it says isint; for ETH3D,
/// disparities larger than the width are holes; for KITTI, D1 is that of the map after
/// fillRowsFromBackground(). Thresholds are in pixels of the given images.
Measurement score(const SceneFiles& files, const Scene& scene, std::string_view method, int num_disparities,
                  const MethodResult& result);

}  // namespace pomona
