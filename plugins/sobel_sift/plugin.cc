// `sobel-sift`: ranges by SIFT on a picture whose edges of four directions are strengthened.
#include "pomona/plugin.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "plugins/common/ranging.h"
#include "plugins/common/stopwatch.h"
#include "plugins/common/triangulation.h"
#include "plugins/sobel_sift/four_direction_sobel.h"

namespace pomona {
namespace {

// What the sensor's own measures make of the rig: f in pixels is f / (width of the sensor / of the image).
StereoCalibration calibrationOf(const StereoCalibration& rig, const PluginSettings& s, int width) {
  if (!s.isOn("physical_sensor")) return rig;
  StereoCalibration sensor = rig;
  sensor.focal_px = s.real("focal_mm") / s.real("sensor_width_mm") * width;
  sensor.baseline_m = s.real("baseline_mm") / 1000;
  return sensor;
}

// The values that differ from those of RangingOptions.
RangingOptions rangingDefaults() {
  RangingOptions options;
  options.band.max_row_offset_px = 1;
  options.band.min_disparity_px = 1;
  options.refinement.radius_px = 7;
  return options;
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What the mask shows, as far away as the points in the middle of the order say.
SparseObject targetOf(const cv::Mat& mask, const std::vector<SparsePoint>& points) {
  SparseObject target;
  target.label = "target";
  target.box_px = cv::boundingRect(mask);
  std::vector<double> x, y, z;
  for (const SparsePoint& p : points) {
    if (!std::isfinite(p.point_m.z)) continue;
    x.push_back(p.point_m.x);
    y.push_back(p.point_m.y);
    z.push_back(p.point_m.z);
  }
  target.support = static_cast<int>(z.size());
  if (z.empty()) {
    target.why_not = "no match inside of the mask";
    return target;
  }
  target.point_m = {medianOf(x), medianOf(y), medianOf(z)};
  target.distance_m = distanceOf(target.point_m);
  target.bearing_deg = bearingOf(target.point_m);
  for (double& value : z) value = std::abs(value - target.point_m.z);
  constexpr double kSigmaPerMedianDeviation = 1.4826, kMedianToMean = 1.2533;  // of a normal distribution
  const double scatter_m = kSigmaPerMedianDeviation * medianOf(z);
  target.sigma_m = kMedianToMean * scatter_m / std::sqrt(static_cast<double>(z.size())) * target.distance_m /
                   target.point_m.z;
  return target;
}

class SobelSift final : public SparseStereoPlugin {
 public:
  std::string name() const override { return "sobel-sift"; }
  std::string description() const override {
    return "SIFT on gray values mixed with four-direction Sobel edges; ranges what the mask shows";
  }

  std::vector<PluginParameter> parameters() const override {
    std::vector<PluginParameter> all{
        realParameter("edge_weight", "Of the edges in the picture that SIFT works on; the rest is gray", 0.2,
                      0, 1),
        realParameter("contrast_threshold", "SIFT's, as OpenCV counts it", 0.016, 0.001, 0.5),
        switchParameter("physical_sensor", "Range by the three measures below, not by the calibration",
                        false),
        realParameter("focal_mm", "Focal length", 6, 0.1, 1000),
        realParameter("baseline_mm", "Between the cameras", 60, 1, 10000),
        realParameter("sensor_width_mm", "Of the part of the sensor that the view shows", 3.2, 0.1, 100)};
    const std::vector<PluginParameter> ranging = rangingParameters(rangingDefaults());
    all.insert(all.end(), ranging.begin(), ranging.end());
    return all;
  }

  std::vector<ParameterSet> parameterSets() const override {
    return {{"faithful",
             "As published: edges in the picture, all against all, then the culls; ranges by the sensor's "
             "measures",
             {{"edge_weight", "0.5"},
              {"contrast_threshold", "0.04"},
              {"along_rows", "off"},
              {"mutual", "off"},
              {"max_row_offset_px", "10"},
              {"min_disparity_px", "0.001"},
              {"refine", "off"},
              {"physical_sensor", "on"}}}};
  }

  SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                   const PluginInputs& inputs) override {
    const PluginSettings& s = inputs.settings;
    const cv::Mat left_gray = grayOf(pair.left), right_gray = grayOf(pair.right);
    const SiftOptions sift{s.real("contrast_threshold"), 0};
    Stopwatch watch;
    const double edge_weight = s.real("edge_weight");
    const ViewFeatures left = siftFeatures(fusedWithEdges(left_gray, edge_weight), inputs.mask, sift);
    const ViewFeatures right = siftFeatures(fusedWithEdges(right_gray, edge_weight), {}, sift);
    const double features_ms = watch.lapMs();
    RangingOptions ranging = rangingOptions(s);
    ranging.matching.threads = inputs.threads;
    RangedMatches ranged =
        rangeMatches(left_gray, right_gray, left, right, calibrationOf(rig, s, left_gray.cols), ranging);
    SparseResult result;
    result.figures = figuresOf(left, right, ranged, features_ms);
    result.points = std::move(ranged.points);
    if (!inputs.mask.empty()) {
      for (SparsePoint& p : result.points) p.object = 0;
      result.objects.push_back(targetOf(inputs.mask, result.points));
    }
    return result;
  }
};

}  // namespace
}  // namespace pomona

POMONA_PLUGIN(pomona::SobelSift)
