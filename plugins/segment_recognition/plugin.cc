// The plugin `segment-recognition`: known objects, looked for where the disparity map shows something near.
#include <string>
#include <vector>

#include "plugins/common/known_objects.h"
#include "plugins/segment_recognition/recognition.h"

namespace pomona {
namespace {

class SegmentRecognition final : public SparseStereoPlugin {
 public:
  std::string name() const override { return "segment-recognition"; }
  std::string description() const override {
    return "Recognises known objects by features from the near regions of a disparity map";
  }

  std::vector<PluginParameter> parameters() const override {
    std::vector<PluginParameter> parameters = KnownObjects::parameters("frontal");
    const std::vector<PluginParameter> own = {
        choiceParameter("filter", "Which features to compare: from near regions, on epipolar lines, or all",
                        {"disparity", "epipolar", "none"}),
        choiceParameter("feature_disparity", "By the dense map, or by partners in the right view",
                        {"map", "partner"}),
        choiceParameter("region_map", "The map that regions are made from", {"engine", "block-matching"}),
        realParameter("far_m", "Depth from which on all is background", 3, 0.01, 1000),
        integerParameter("opening_px", "Side of the square that opens the near pixels", 7, 1, 101),
        integerParameter("min_area_px", "Of a region", 400, 1, 1000000),
        realParameter("sensitivity", "Divides the contrast that features of the views need", 2, 0.1, 20),
        realParameter("pair_ratio", "Of the distances between the views' features, at most", 0.8, 0, 1),
        realParameter("max_epipolar_px", "Distance of a partner from the epipolar line", 1, 0, 50),
        realParameter("ratio", "Of the distances to the nearest and the next known feature, at most", 0.8, 0,
                      1),
        realParameter("reprojection_px", "How far off a match may be from where the object has it", 3, 0.1,
                      50),
        choiceParameter("place_model", "An affine map, then a homography near it; or a homography at once",
                        {"affine-first", "homography"}),
        realParameter("min_likeness",
                      "Correlation of the picture with what the view shows at its place; affine-first only",
                      0.65, -1, 1),
        integerParameter("min_agreeing", "Matches that must agree on the object's place", 6, 4, 1000),
        choiceParameter("object_ranging", "By the plane that aligns the views, or by the features' mean",
                        {"plane", "mean"})};
    parameters.insert(parameters.end(), own.begin(), own.end());
    return parameters;
  }

  std::vector<ParameterSet> parameterSets() const override {
    std::vector<std::pair<std::string, std::string>> values = KnownObjects::faithful("surf-64");
    values.insert(values.end(), {{"feature_disparity", "partner"},
                                 {"sensitivity", "1"},
                                 {"region_map", "block-matching"},
                                 {"ratio", "0.7"},
                                 {"place_model", "homography"},
                                 {"min_agreeing", "4"},
                                 {"object_ranging", "mean"}});
    return {{"faithful",
             "As published, " + KnownObjects::faithfulFeatures("surf-64") +
                 ": features in both views, regions by block matching, points averaged",
             values}};
  }

  SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                   const PluginInputs& inputs) override {
    const PluginSettings& settings = inputs.settings;
    RecognitionOptions options;
    const std::string& filter = settings.text("filter");
    options.filter = filter == "none"       ? FeatureFilter::kNone
                     : filter == "epipolar" ? FeatureFilter::kEpipolar
                                            : FeatureFilter::kDisparity;
    options.disparity =
        settings.text("feature_disparity") == "map" ? FeatureDisparity::kMap : FeatureDisparity::kPartner;
    options.engine_map = settings.text("region_map") == "engine";
    options.regions.far_m = settings.real("far_m");
    options.regions.opening_px = settings.integer("opening_px");
    options.regions.min_area_px = settings.integer("min_area_px");
    options.sensitivity = settings.real("sensitivity");
    options.pair_ratio = settings.real("pair_ratio");
    options.max_epipolar_px = settings.real("max_epipolar_px");
    options.locate.ratio = settings.real("ratio");
    options.locate.reprojection_px = settings.real("reprojection_px");
    if (settings.text("place_model") == "homography") options.locate.model = PlaceModel::kHomography;
    options.locate.min_likeness = settings.real("min_likeness");
    options.locate.min_agreeing = settings.integer("min_agreeing");
    options.ranging =
        settings.text("object_ranging") == "mean" ? ObjectRanging::kMean : ObjectRanging::kPlane;
    return recogniseObjects(pair, rig, inputs.mask, inputs.dense, objects_.open(settings), options);
  }

 private:
  KnownObjects objects_;
};

}  // namespace
}  // namespace pomona

POMONA_PLUGIN(pomona::SegmentRecognition)
