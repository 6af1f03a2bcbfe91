// A plugin for tests: ranges the middle of the image by the dense map, or fails as it is told to.
#include <stdexcept>

#include "pomona/plugin.h"

namespace {

class Middle final : public pomona::SparseStereoPlugin {
 public:
  std::string name() const override { return "middle"; }
  std::string description() const override { return "The point in the middle of the left view"; }
  std::vector<pomona::PluginParameter> parameters() const override {
    return {
        pomona::choiceParameter("fails", "How to fail", {"never", "error", "number", "object", "picture"}),
        pomona::realParameter("sigma_px", "Standard deviation of the disparity", 0.25, 0, 10),
        pomona::integerParameter("points", "How often to report the point", 1, 0, 100),
        pomona::switchParameter("found", "Whether to find the object", true),
        pomona::textParameter("label", "What the object is called", "middle")};
  }
  std::vector<pomona::ParameterSet> parameterSets() const override {
    return {{"faithful", "As it was published", {{"sigma_px", "1"}, {"points", "3"}}}};
  }

  pomona::SparseResult run(const pomona::RectifiedPair& pair, const pomona::StereoCalibration& rig,
                           const pomona::PluginInputs& inputs) override {
    const std::string& fails = inputs.settings.text("fails");
    if (fails == "error") throw std::runtime_error("told to fail");
    if (fails == "number") throw 7;
    const cv::Point middle(pair.left.cols / 2, pair.left.rows / 2);
    pomona::SparsePoint point;
    point.object = fails == "object" ? 1 : 0;
    point.left_px = middle;
    point.disparity_px = inputs.dense().disparity.at<float>(middle);
    point.right_px = cv::Point2f(point.left_px.x - point.disparity_px, point.left_px.y);
    point.sigma_px = static_cast<float>(inputs.settings.real("sigma_px"));
    const double z_m = rig.focal_px * rig.baseline_m / (point.disparity_px + rig.doffs_px);
    point.point_m = cv::Point3d((middle.x - rig.cx_px) * z_m / rig.focal_px,
                                (middle.y - rig.cy_px) * z_m / rig.focal_px, z_m);
    pomona::SparseResult result;
    result.points.assign(inputs.settings.integer("points"), point);
    result.objects.resize(1);
    result.objects[0].label = inputs.settings.text("label");
    result.objects[0].support = static_cast<int>(result.points.size());
    if (inputs.settings.isOn("found")) {
      result.objects[0].point_m = point.point_m;
      result.objects[0].distance_m = z_m;
      result.objects[0].outline_px = {middle + cv::Point(-9, -9), middle + cv::Point(9, -9),
                                      middle + cv::Point(0, 9)};
    } else {
      result.objects[0].why_not = "told not to";
    }
    result.figures = {{"runs", static_cast<double>(++runs_), ""}};
    result.pictures = {{"gray", cv::Mat(4, 6, fails == "picture" ? CV_32F : CV_8U, cv::Scalar(99))}};
    return result;
  }

 private:
  int runs_ = 0;
};

}  // namespace

POMONA_PLUGIN(Middle)
