#include "plugins/common/ranging.h"

#include <cmath>
#include <cstddef>

#include "plugins/common/stopwatch.h"
#include "plugins/common/triangulation.h"

namespace pomona {
namespace {

std::vector<KeypointMatch> matchesInBand(const ViewFeatures& left, const ViewFeatures& right,
                                         const RangingOptions& options) {
  std::vector<KeypointMatch> matches =
      matchKeypoints(left.descriptors, right.descriptors, options.matching,
                     options.along_rows ? options.band : RowBand{}, left.keypoints, right.keypoints);
  std::erase_if(matches, [&](const KeypointMatch& m) {
    return !options.band.allows(left.keypoints[m.left].pt, right.keypoints[m.right].pt);
  });
  return matches;
}

// As people write it: 0.7f is 0.699999988.
double written(float value) {
  constexpr double kDigits = 1e4;
  return std::round(kDigits * value) / kDigits;
}

}  // namespace

std::vector<PluginParameter> rangingParameters(const RangingOptions& d) {
  return {switchParameter("along_rows", "Match among what the constraints allow, instead of among all",
                          d.along_rows),
          realParameter("ratio", "Of nearest to second nearest distance", written(d.matching.ratio), 0.1, 1),
          switchParameter("mutual", "A match must be the nearest from both sides", d.matching.mutual),
          realParameter("max_row_offset_px", "Rows between the keypoints of a match",
                        written(d.band.max_row_offset_px), 0, 100),
          realParameter("min_disparity_px", "Smallest disparity of a match", written(d.band.min_disparity_px),
                        0, 8192),
          switchParameter("refine", "Register the gray values around each match; drop those that don't fit",
                          d.refine),
          integerParameter("window_radius_px", "Of the registered windows", d.refinement.radius_px, 1, 50),
          realParameter("max_step_px", "How far registering may move a disparity",
                        written(d.refinement.max_step_px), 0.01, 10),
          realParameter("min_correlation", "Of the registered windows", written(d.refinement.min_correlation),
                        0, 1),
          realParameter("sigma_px", "Standard deviation of disparities that are not refined",
                        written(d.sigma_px), 0.01, 10)};
}

RangingOptions rangingOptions(const PluginSettings& s) {
  const auto real = [&](const char* name) { return static_cast<float>(s.real(name)); };
  RangingOptions options;
  options.matching.ratio = real("ratio");
  options.matching.mutual = s.isOn("mutual");
  options.band.max_row_offset_px = real("max_row_offset_px");
  options.band.min_disparity_px = real("min_disparity_px");
  options.along_rows = s.isOn("along_rows");
  options.refine = s.isOn("refine");
  options.refinement = {s.integer("window_radius_px"), real("max_step_px"), real("min_correlation")};
  options.sigma_px = real("sigma_px");
  return options;
}

RangedMatches rangeMatches(const cv::Mat& left_gray, const cv::Mat& right_gray, const ViewFeatures& left,
                           const ViewFeatures& right, const StereoCalibration& calibration,
                           const RangingOptions& options) {
  RangedMatches ranged;
  Stopwatch watch;
  const std::vector<KeypointMatch> matches = matchesInBand(left, right, options);
  ranged.matches = static_cast<int>(matches.size());
  ranged.matching_ms = watch.lapMs();
  for (const KeypointMatch& m : matches) {
    const cv::Point2f left_px = left.keypoints[m.left].pt;
    cv::Point2f right_px = right.keypoints[m.right].pt;
    float sigma_px = options.sigma_px;
    if (options.refine) {
      const RefinedDisparity refined =
          refineDisparity(left_gray, right_gray, left_px, left_px.x - right_px.x, options.refinement);
      if (!refined.ok) continue;
      right_px = {left_px.x - refined.disparity_px, left_px.y};
      sigma_px = refined.sigma_px;
    }
    ranged.points.push_back(triangulate(calibration, left_px, right_px, sigma_px));
  }
  ranged.refinement_ms = watch.lapMs();
  return ranged;
}

std::vector<SparseFigure> figuresOf(const ViewFeatures& left, const ViewFeatures& right,
                                    const RangedMatches& ranged, double features_ms) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  return {{"features left", count(left.keypoints.size()), ""},
          {"features right", count(right.keypoints.size()), ""},
          {"matches", static_cast<double>(ranged.matches), ""},
          {"verified", count(ranged.points.size()), ""},
          {"features", features_ms, "ms"},
          {"matching", ranged.matching_ms, "ms"},
          {"refinement", ranged.refinement_ms, "ms"}};
}

}  // namespace pomona
