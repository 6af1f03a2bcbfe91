#include "apps/measure.h"

#include <algorithm>

#include "pomona/engine.h"
#include "sgm/kernels.h"

namespace pomona {
namespace {

EvaluationRules rulesOf(const SceneFiles& files, const Scene& scene) {
  if (files.layout == SceneLayout::kEth3d) return EvaluationRules::eth3d(scene.left.cols);
  EvaluationRules rules;
  if (!scene.calibration) return rules;
  if (const int ndisp = scene.calibration->stereo.num_disparities; ndisp > 0)
    rules = EvaluationRules::middlebury(ndisp);
  rules.round = scene.calibration->integer_disparities;
  return rules;
}

KittiErrors kittiErrorsOfFilled(const MethodResult& result, const Scene& scene, const cv::Mat& mask) {
  cv::Mat filled = result.disparity.clone();
  fillRowsFromBackground(filled);
  return kittiErrors(filled, scene.ground_truth, scene.objects, mask);
}

RegionFigures figuresOver(const cv::Mat& mask, const SceneFiles& files, const Scene& scene,
                          const MethodResult& result) {
  RegionFigures figures;
  figures.errors = compareWithTruth(result.disparity, scene.ground_truth, mask, rulesOf(files, scene));
  if (!result.confidence.empty())
    figures.curve = coverageCurve(result.disparity, result.confidence, scene.ground_truth, mask);
  figures.subpixel = subpixelErrors(result.disparity, scene.ground_truth, mask);
  if (files.layout == SceneLayout::kKitti2012 || files.layout == SceneLayout::kKitti2015)
    figures.kitti = kittiErrorsOfFilled(result, scene, mask);
  return figures;
}

}  // namespace

int disparitiesToSearch(const SceneFiles& files, const Scene& scene) {
  const int most = std::min(kMaxDisparities, scene.left.cols);
  if (files.num_disparities > 0) return std::min(files.num_disparities, most);
  if (const int count = disparitiesToReach(scene.ground_truth); count > 0) return std::min(count, most);
  const int ndisp = scene.calibration ? scene.calibration->stereo.num_disparities : 0;
  return ndisp > 0 ? std::min(ndisp, most) : estimateNumDisparities(scene.left, scene.right);
}

MethodResult runTimed(Method& method, const Scene& scene, const MethodOptions& options) {
  MethodResult result = method.run(scene.left, scene.right, options);
  if (result.milliseconds < kWarmUpLimit_ms) result = method.run(scene.left, scene.right, options);
  return result;
}

Measurement score(const SceneFiles& files, const Scene& scene, std::string_view method, int num_disparities,
                  const MethodResult& result) {
  Measurement measurement;
  measurement.scene = files.name;
  measurement.method = method;
  measurement.size = scene.left.size();
  measurement.num_disparities = num_disparities;
  measurement.milliseconds = result.milliseconds;
  if (scene.ground_truth.empty()) return measurement;
  measurement.all = figuresOver({}, files, scene, result);
  if (!scene.nonoccluded.empty())
    measurement.nonoccluded = figuresOver(scene.nonoccluded, files, scene, result);
  return measurement;
}

}  // namespace pomona
