// `region-sift`: SIFT in regions of interest, for the map of a robot that drives over a floor with little
// texture.
#include "pomona/plugin.h"

#include <string>
#include <utility>
#include <vector>

#include "plugins/common/ranging.h"
#include "plugins/common/stopwatch.h"
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

// The values that differ from those of RangingOptions.
RangingOptions rangingDefaults() {
  RangingOptions options;
  options.matching.ratio = 0.7f;
  options.band.max_row_offset_px = 1;
  options.band.min_disparity_px = 3;
  return options;
}

RangingOptions rangingOptionsFor(const PluginSettings& s, const StereoCalibration& rig, int width) {
  RangingOptions options = rangingOptions(s);
  options.matching.distance = DescriptorDistance::kCombined;
  options.band.max_disparity_px = static_cast<float>(s.integer("max_disparity_px"));
  if (options.band.max_disparity_px == 0)
    options.band.max_disparity_px = static_cast<float>(rig.num_disparities > 0 ? rig.num_disparities : width);
  return options;
}

class RegionSift final : public SparseStereoPlugin {
 public:
  std::string name() const override { return "region-sift"; }
  std::string description() const override {
    return "SIFT in regions of interest, also on floors with little texture; a map from front and above";
  }

  std::vector<PluginParameter> parameters() const override {
    std::vector<PluginParameter> all{
        realParameter("far_share", "Share of the height that is the far strip", 0.33, 0, 0.9),
        switchParameter("far_region", "Use the far strip, too", false),
        switchParameter("whole_region", "Use the whole view, too", false),
        switchParameter("joined", "One pass over all regions instead of one for each", true),
        switchParameter("equalise", "Equalise the histogram of each region", false),
        realParameter("scale", "Of the picture that SIFT works on to the view", 0.6, 0.25, 1),
        realParameter("contrast_threshold", "SIFT's, as OpenCV counts it", 0.004, 0.001, 0.5),
        integerParameter("max_features", "Of each region, the strongest; 0: all", 1200, 0, 100000),
        integerParameter("max_disparity_px", "Largest disparity; 0: the calibration's bound, else the width",
                         0, 0, 8192),
        realParameter("camera_height_m", "Of the left camera above the floor, for the map", 0.5, 0, 100),
        switchParameter("map", "Draw the map", true)};
    const std::vector<PluginParameter> ranging = rangingParameters(rangingDefaults());
    all.insert(all.end(), ranging.begin(), ranging.end());
    return all;
  }

  std::vector<ParameterSet> parameterSets() const override {
    return {{"faithful",
             "As published: histograms equalised in each region, all against all, then the constraints",
             {{"joined", "off"},
              {"equalise", "on"},
              {"scale", "1"},
              {"contrast_threshold", "0.04"},
              {"max_features", "0"},
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

    RangingOptions ranging = rangingOptionsFor(settings, rig, left_gray.cols);
    ranging.matching.threads = inputs.threads;
    RangedMatches ranged = rangeMatches(left_gray, right_gray, left, right, rig, ranging);
    SparseResult result;
    result.figures = figuresOf(left, right, ranged, features_ms);
    result.points = std::move(ranged.points);
    watch.lapMs();
    if (settings.isOn("map")) result.pictures = mapPictures(result.points, settings.real("camera_height_m"));
    result.figures.push_back({"map", watch.lapMs(), "ms"});
    return result;
  }
};

}  // namespace
}  // namespace pomona

POMONA_PLUGIN(pomona::RegionSift)
