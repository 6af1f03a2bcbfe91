// `region-sift`: SIFT in regions of interest, for the map of a robot that drives over a floor with little
// texture.
#include "pomona/plugin.h"

#include <string>
#include <utility>
#include <vector>

#include "plugins/common/matching.h"
#include "plugins/common/refine_disparity.h"
#include "plugins/common/stopwatch.h"
#include "plugins/common/triangulation.h"
#include "plugins/region_sift/map_pictures.h"
#include "plugins/region_sift/regions.h"

namespace pomona {
namespace {

RegionOptions regionOptions(const PluginSettings& s) {
  RegionOptions options;
  options.far_share = s.real("far_share");
  options.far_region = s.isOn("far_region");
  options.whole_region = s.isOn("whole_region");
  options.joined = s.isOn("joined");
  options.equalise = s.isOn("equalise");
  options.scale = s.real("scale");
  options.sift = {s.real("contrast_threshold"), s.integer("max_features")};
  return options;
}

RowBand bandOf(const PluginSettings& s, const StereoCalibration& rig, int width) {
  RowBand band;
  band.max_row_offset_px = static_cast<float>(s.real("max_row_offset_px"));
  band.min_disparity_px = static_cast<float>(s.real("min_disparity_px"));
  band.max_disparity_px = static_cast<float>(s.integer("max_disparity_px"));
  if (band.max_disparity_px == 0) band.max_disparity_px = static_cast<float>(rig.num_disparities);
  if (band.max_disparity_px == 0) band.max_disparity_px = static_cast<float>(width);
  return band;
}

// Matches that satisfy the constraints: searched for among those that do, or, as published, among all and
// then picked.
std::vector<KeypointMatch> matched(const ViewFeatures& left, const ViewFeatures& right, const RowBand& band,
                                   const PluginSettings& s, int threads) {
  MatchOptions options;
  options.distance = DescriptorDistance::kCombined;
  options.ratio = static_cast<float>(s.real("ratio"));
  options.mutual = s.isOn("mutual");
  options.threads = threads;
  std::vector<KeypointMatch> matches =
      matchKeypoints(left.descriptors, right.descriptors, options, s.isOn("along_rows") ? band : RowBand{},
                     left.keypoints, right.keypoints);
  std::erase_if(matches, [&](const KeypointMatch& m) {
    return !band.allows(left.keypoints[m.left].pt, right.keypoints[m.right].pt);
  });
  return matches;
}

class RegionSift final : public SparseStereoPlugin {
 public:
  std::string name() const override { return "region-sift"; }
  std::string description() const override {
    return "SIFT in regions of interest, also on floors with little texture; a map from front and above";
  }

  std::vector<PluginParameter> parameters() const override {
    return {
        realParameter("far_share", "Share of the height that is the far strip", 0.33, 0, 0.9),
        switchParameter("far_region", "Use the far strip, too", false),
        switchParameter("whole_region", "Use the whole view, too", false),
        switchParameter("joined", "One pass over all regions instead of one for each", true),
        switchParameter("equalise", "Equalise the histogram of each region", false),
        realParameter("scale", "Of the picture that SIFT works on to the view", 0.6, 0.25, 1),
        realParameter("contrast_threshold", "SIFT's, as OpenCV counts it", 0.004, 0.001, 0.5),
        integerParameter("max_features", "Of each region, the strongest; 0: all", 0, 0, 100000),
        switchParameter("along_rows", "Match among what the constraints allow, instead of among all", true),
        realParameter("ratio", "Of nearest to second nearest distance", 0.7, 0.1, 1),
        switchParameter("mutual", "A match must be the nearest from both sides", true),
        realParameter("max_row_offset_px", "Rows between the keypoints of a match", 1, 0, 100),
        realParameter("min_disparity_px", "Smallest disparity of a match", 3, 0, 8192),
        integerParameter("max_disparity_px", "Largest disparity; 0: the calibration's bound, else the width",
                         0, 0, 8192),
        switchParameter("refine", "Register the pixels around each match; drop those that don't fit", true),
        realParameter("max_step_px", "How far registering may move a disparity", 1, 0.01, 10),
        realParameter("min_correlation", "Of the registered windows", 0.8, 0, 1),
        realParameter("sigma_px", "Standard deviation of disparities that were not refined", 0.5, 0.01, 10),
        realParameter("camera_height_m", "Of the left camera above the floor, for the map", 0.5, 0, 100),
        switchParameter("map", "Draw the map", true)};
  }

  std::vector<ParameterSet> parameterSets() const override {
    return {{"faithful",
             "As published: histograms equalised in each region, all against all, then the constraints",
             {{"joined", "off"},
              {"equalise", "on"},
              {"scale", "1"},
              {"contrast_threshold", "0.04"},
              {"along_rows", "off"},
              {"mutual", "off"},
              {"max_row_offset_px", "3"},
              {"max_disparity_px", "8192"},
              {"refine", "off"}}}};
  }

  SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                   const PluginInputs& inputs) override {
    const PluginSettings& settings = inputs.settings;
    const cv::Mat left_gray = grayOf(pair.left), right_gray = grayOf(pair.right);
    Stopwatch watch;
    const RegionOptions regions = regionOptions(settings);
    const ViewFeatures left = regionFeatures(left_gray, inputs.mask, regions);
    const ViewFeatures right = regionFeatures(right_gray, {}, regions);
    const double features_ms = watch.lapMs();

    const RowBand band = bandOf(settings, rig, left_gray.cols);
    const std::vector<KeypointMatch> matches = matched(left, right, band, settings, inputs.threads);
    const double matching_ms = watch.lapMs();

    SparseResult result;
    for (const KeypointMatch& m : matches)
      addPoint(left_gray, right_gray, left.keypoints[m.left].pt, right.keypoints[m.right].pt, rig, settings,
               result.points);
    const double refinement_ms = watch.lapMs();
    if (settings.isOn("map")) result.pictures = mapPictures(result.points, settings.real("camera_height_m"));
    result.figures = {{"features left", static_cast<double>(left.keypoints.size()), ""},
                      {"features right", static_cast<double>(right.keypoints.size()), ""},
                      {"matches", static_cast<double>(matches.size()), ""},
                      {"verified", static_cast<double>(result.points.size()), ""},
                      {"features", features_ms, "ms"},
                      {"matching", matching_ms, "ms"},
                      {"refinement", refinement_ms, "ms"},
                      {"map", watch.lapMs(), "ms"}};
    return result;
  }

 private:
  static void addPoint(const cv::Mat& left, const cv::Mat& right, cv::Point2f left_px, cv::Point2f right_px,
                       const StereoCalibration& rig, const PluginSettings& settings,
                       std::vector<SparsePoint>& points) {
    auto sigma_px = static_cast<float>(settings.real("sigma_px"));
    if (settings.isOn("refine")) {
      RefineOptions options;
      options.max_step_px = static_cast<float>(settings.real("max_step_px"));
      options.min_correlation = static_cast<float>(settings.real("min_correlation"));
      const RefinedDisparity refined = refineDisparity(left, right, left_px, left_px.x - right_px.x, options);
      if (!refined.ok) return;
      right_px = {left_px.x - refined.disparity_px, left_px.y};
      sigma_px = refined.sigma_px;
    }
    points.push_back(triangulate(rig, left_px, right_px, sigma_px));
  }
};

}  // namespace
}  // namespace pomona

POMONA_PLUGIN(pomona::RegionSift)
