#include "bench/accuracy/figures.h"

#include <limits>

#include "pomona/evaluation.h"

namespace pomona {

Figures noFigures() {
  Figures figures;
  figures.fill(std::numeric_limits<double>::quiet_NaN());
  return figures;
}

Figures figuresOf(const MethodResult& result, const cv::Mat& truth, const cv::Mat& mask) {
  static_assert(kWrong05 == kBadThresholds_px.size() && kAverageError == 2 * kBadThresholds_px.size());
  static_assert(kErrorQuantiles_percent[1] == 90 && kErrorQuantiles_percent[3] == 99);
  const DisparityErrors errors = compareWithTruth(result.disparity, truth, mask);
  const SubpixelErrors inliers = subpixelErrors(result.disparity, truth, mask);
  Figures figures = noFigures();
  for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i) {
    figures[kBad05 + i] = errors.badPercent(i);
    figures[kWrong05 + i] = errors.wrongPercent(i);
  }
  figures[kAverageError] = errors.averageErrorPx();
  figures[kRmsError] = errors.rmsErrorPx();
  figures[kErrorQuantile90] = errors.quantile_px[1];
  figures[kErrorQuantile99] = errors.quantile_px[3];
  figures[kCoverage] = errors.coveragePercent();
  if (!result.confidence.empty())
    figures[kExcessArea] =
        coverageCurve(result.disparity, result.confidence, truth, mask).excessAreaPercent();
  figures[kInlierBias] = inliers.all.biasPx();
  figures[kInlierRms] = inliers.all.rmsPx();
  return figures;
}

Figures meanOf(const std::vector<Figures>& all) {
  Figures mean;
  for (std::size_t i = 0; i < kFigures; ++i) {
    std::vector<double> values;
    for (const Figures& figures : all) values.push_back(figures[i]);
    mean[i] = weightedMean(values);
  }
  return mean;
}

SceneFigures MethodFigures::mean() const {
  std::vector<Figures> all, nonoccluded;
  for (const SceneFigures& scene : scenes) {
    all.push_back(scene.all);
    nonoccluded.push_back(scene.nonoccluded);
  }
  return {"mean", meanOf(all), meanOf(nonoccluded)};
}

}  // namespace pomona
