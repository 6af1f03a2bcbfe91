#include "bench/accuracy/figures.h"

#include <cmath>
#include <limits>

namespace pomona {

Figures figuresOf(const DisparityErrors& errors) {
  static_assert(kWrong05 == kBadThresholds_px.size() && kAverageError == 2 * kBadThresholds_px.size());
  Figures figures;
  for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i) {
    figures[kBad05 + i] = errors.badPercent(i);
    figures[kWrong05 + i] = errors.wrongPercent(i);
  }
  figures[kAverageError] = errors.averageErrorPx();
  figures[kCoverage] = errors.coveragePercent();
  return figures;
}

Figures meanOf(const std::vector<Figures>& all) {
  Figures mean;
  for (int i = 0; i < kFigures; ++i) {
    double sum = 0;
    int count = 0;
    for (const Figures& figures : all) {
      if (std::isnan(figures[i])) continue;
      sum += figures[i];
      ++count;
    }
    mean[i] = count ? sum / count : std::numeric_limits<double>::quiet_NaN();
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
