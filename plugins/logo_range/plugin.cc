// The plugin `logo-range`: known signs, or a detector's boxes, and how far away they are.
#include <optional>
#include <string>
#include <vector>

#include "plugins/common/known_objects.h"
#include "plugins/common/stopwatch.h"
#include "plugins/logo_range/box_range.h"
#include "plugins/logo_range/logo_range.h"

namespace pomona {
namespace {

class LogoRange final : public SparseStereoPlugin {
 public:
  std::string name() const override { return "logo-range"; }
  std::string description() const override {
    return "Finds known signs, or what a detector boxes, and tells distance and direction";
  }

  std::vector<PluginParameter> parameters() const override {
    std::vector<PluginParameter> parameters = KnownObjects::parameters("wide");
    const std::vector<PluginParameter> own = {
        switchParameter("upper_half", "Look for signs in the upper half of the left view only", false),
        realParameter("sensitivity", "Divides the contrast that features of the views need", 2, 0.1, 20),
        realParameter("ratio", "Of the distances to the nearest and the next known feature, at most", 0.85, 0,
                      1),
        realParameter("reprojection_px", "How far off a match may be from where the sign has it", 3, 0.1, 50),
        choiceParameter("place_model", "An affine map, then a homography near it; or a homography at once",
                        {"affine-first", "homography"}),
        realParameter("min_likeness",
                      "Correlation of the picture with what the view shows at its place; affine-first only",
                      0.65, -1, 1),
        integerParameter("min_agreeing", "Matches that must agree on the sign's place", 6, 4, 1000),
        realParameter("pair_ratio", "Of the distances between the views' features, at most", 0.85, 0, 1),
        realParameter("max_row_offset_px", "Between the views' features", 2, 0, 50),
        choiceParameter("sign_ranging", "By the plane that aligns the views, or by the features' mean",
                        {"plane", "mean"}),
        textParameter("network", "A detector to be used in place of signs: .cfg (Darknet) or .onnx"),
        textParameter("weights", "Of a Darknet network; empty: beside it, with the ending .weights"),
        textParameter("labels", "File with the names of the detector's classes, one a line"),
        integerParameter("input_size_px", "Side of the detector's input", 416, 16, 4096),
        realParameter("min_confidence", "Of a box", 0.25, 0, 1),
        realParameter("max_overlap", "Of two boxes of one class: intersection by union", 0.45, 0, 1),
        choiceParameter("box_ranging",
                        "By the dense map inside the box, or by the centres of both views' boxes",
                        {"dense", "centers"})};
    parameters.insert(parameters.end(), own.begin(), own.end());
    return parameters;
  }

  std::vector<ParameterSet> parameterSets() const override {
    std::vector<std::pair<std::string, std::string>> values = KnownObjects::faithful("surf-128");
    values.insert(values.end(), {{"upper_half", "on"},
                                 {"sensitivity", "1"},
                                 {"ratio", "0.7"},
                                 {"place_model", "homography"},
                                 {"min_agreeing", "4"},
                                 {"pair_ratio", "0.7"},
                                 {"sign_ranging", "mean"},
                                 {"box_ranging", "centers"}});
    return {{"faithful",
             "As published, " + KnownObjects::faithfulFeatures("surf-128") +
                 ": one view per sign, points averaged, boxes ranged by their centres",
             values}};
  }

  SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                   const PluginInputs& inputs) override {
    const PluginSettings& settings = inputs.settings;
    if (!settings.text("network").empty()) return runDetector(pair, rig, inputs);
    LogoRangeOptions options;
    options.sensitivity = settings.real("sensitivity");
    options.upper_half = settings.isOn("upper_half");
    options.locate.ratio = settings.real("ratio");
    options.locate.reprojection_px = settings.real("reprojection_px");
    if (settings.text("place_model") == "homography") options.locate.model = PlaceModel::kHomography;
    options.locate.min_likeness = settings.real("min_likeness");
    options.locate.min_agreeing = settings.integer("min_agreeing");
    options.pair_ratio = settings.real("pair_ratio");
    options.max_row_offset_px = settings.real("max_row_offset_px");
    options.ranging = settings.text("sign_ranging") == "mean" ? ObjectRanging::kMean : ObjectRanging::kPlane;
    return rangeSigns(pair, rig, inputs.mask, signs_.open(settings), options);
  }

 private:
  static SparseResult runDetector(const RectifiedPair& pair, const StereoCalibration& rig,
                                  const PluginInputs& inputs) {
    const PluginSettings& settings = inputs.settings;
    DetectorOptions options;
    options.network = settings.text("network");
    options.weights = settings.text("weights");
    options.labels = settings.text("labels");
    options.input_size_px = settings.integer("input_size_px");
    options.min_confidence = settings.real("min_confidence");
    options.max_overlap = settings.real("max_overlap");
    Detector detector(options);
    const bool by_centers = settings.text("box_ranging") == "centers";
    Stopwatch watch;
    Boxes boxes{detector.detect(pair.left), {}};
    if (by_centers) boxes.right = detector.detect(pair.right);
    if (!inputs.mask.empty())
      std::erase_if(boxes.left, [&](const Detection& seen) {
        const cv::Rect2f& box = seen.box_px;
        return !inputs.mask.at<std::uint8_t>(int(box.y + box.height / 2), int(box.x + box.width / 2));
      });
    const double detection_ms = watch.lapMs();
    SparseResult result = rangeBoxes(boxes, rig, by_centers ? BoxRanging::kCenters : BoxRanging::kDense,
                                     inputs.dense, [&](int kind) { return detector.labelOf(kind); });
    result.figures = {{"boxes left", double(boxes.left.size()), ""},
                      {"boxes right", double(boxes.right.size()), ""},
                      {"detection", detection_ms, "ms"},
                      {"ranging", watch.lapMs(), "ms"}};
    return result;
  }

  KnownObjects signs_;
};

}  // namespace
}  // namespace pomona

POMONA_PLUGIN(pomona::LogoRange)
