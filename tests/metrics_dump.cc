// metrics_dump DISPARITY CONFIDENCE SIGMA TRUTH [MASK]: every figure of pomona/evaluation.h as JSON, for
// reference/metrics.py to compare with its own.
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "datasets/disparity_file.h"
#include "datasets/image_file.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

void print(const std::string& key, double value) {
  if (std::isnan(value))
    std::printf("\"%s\": null,\n", key.c_str());
  else
    std::printf("\"%s\": %.17g,\n", key.c_str(), value);
}

void printErrors(const std::string& prefix, const DisparityErrors& e) {
  print(prefix + "known", static_cast<double>(e.known));
  print(prefix + "invalid", e.invalidPercent());
  print(prefix + "coverage", e.coveragePercent());
  for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i) {
    const std::string t = std::to_string(i);
    print(prefix + "totbad" + t, e.badPercent(i));
    print(prefix + "bad" + t, e.wrongOfKnownPercent(i));
    print(prefix + "wrong" + t, e.wrongPercent(i));
    print(prefix + "A" + std::to_string(kErrorQuantiles_percent[i]), e.quantile_px[i]);
  }
  print(prefix + "avgerr", e.averageErrorPx());
  print(prefix + "rms", e.rmsErrorPx());
}

void dump(int count, char** paths) {
  const cv::Mat d = readDisparity(paths[0]), truth = readDisparity(paths[3]);
  const cv::Mat mask = count > 4 ? readImage(paths[4]) : cv::Mat();
  std::printf("{\n");
  printErrors("plain.", compareWithTruth(d, truth, mask));
  printErrors("middlebury.", compareWithTruth(d, truth, mask, EvaluationRules::middlebury(20)));
  printErrors("eth3d.", compareWithTruth(d, truth, mask, EvaluationRules::eth3d(30)));
  if (d.size() == truth.size()) {
    const cv::Mat confidence = readDisparity(paths[1]), sigma = readDisparity(paths[2]);
    const KittiErrors kitti = kittiErrors(d, truth, mask);
    print("kitti.bg", kitti.background.d1Percent());
    print("kitti.fg", kitti.foreground.d1Percent());
    print("kitti.all", kitti.all().d1Percent());
    print("kitti.found", kitti.all().outlierPercent());
    const CoverageCurve curve = coverageCurve(d, confidence, truth, mask, 1.0f, 7);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      print("curve.coverage" + std::to_string(i), curve.points[i].coverage_percent);
      print("curve.wrong" + std::to_string(i), curve.points[i].wrong_percent);
      print("curve.oracle" + std::to_string(i), curve.points[i].oracle_percent);
    }
    print("curve.area", curve.area_percent);
    print("curve.oracle_area", curve.oracle_area_percent);
    const SubpixelErrors subpixel = subpixelErrors(d, truth, mask, 8);
    print("subpixel.bias", subpixel.all.biasPx());
    print("subpixel.rms", subpixel.all.rmsPx());
    for (std::size_t i = 0; i < subpixel.bins.size(); ++i) {
      print("subpixel.count" + std::to_string(i), static_cast<double>(subpixel.bins[i].count));
      print("subpixel.bias" + std::to_string(i), subpixel.bins[i].biasPx());
      print("subpixel.rms" + std::to_string(i), subpixel.bins[i].rmsPx());
    }
    const SigmaCalibration calibration = sigmaCalibration(d, sigma, truth, mask);
    for (int i = 1; i <= 3; ++i) print("sigma.within" + std::to_string(i), calibration.withinPercent(i));
  }
  std::printf("\"end\": 0\n}\n");
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: metrics_dump DISPARITY CONFIDENCE SIGMA TRUTH [MASK]\n");
    return 2;
  }
  try {
    pomona::dump(argc - 1, argv + 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "metrics_dump: %s\n", error.what());
    return 1;
  }
  return 0;
}
