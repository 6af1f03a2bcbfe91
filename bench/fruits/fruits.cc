// Measures the fruits of rendered orchards and compares with where they are.
//
//   pomona_fruits METHOD REGION FOLDER...
//
// METHOD is a preset, or another method of `pomona eval`; REGION is box (a detector's: the whole outline, off
// by up to a tenth of its size), visible (the box of the visible pixels), circle or mask. FOLDERs are those
// of `pomona render orchard`. Fruits of which 30 % are visible count. Distances to the near surface and to
// the centre, errors in mm and percent, how many are within two of their standard deviations; one line per
// fruit with POMONA_FRUITS_LIST set.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "baselines/method.h"
#include "datasets/scene.h"
#include "pomona/engine.h"
#include "pomona/measure.h"

namespace pomona {
namespace {

constexpr double kLeastVisible = 0.3;

/// Errors of one kind of distance.
struct Errors {
  std::vector<double> mm, percent, sigmas;

  void add(double measured_m, double sigma_m, double true_m) {
    mm.push_back(1000 * std::abs(measured_m - true_m));
    percent.push_back(100 * std::abs(measured_m - true_m) / true_m);
    sigmas.push_back((measured_m - true_m) / sigma_m);
  }
  static double quantile(std::vector<double> values, double q) {
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  }
  void print(const char* name) const {
    double sum = 0, squares = 0, signed_sigmas = 0;
    std::array<double, 3> within{};
    for (const double e : mm) sum += e, squares += e * e;
    for (const double s : sigmas) {
      signed_sigmas += s;
      for (int k = 0; k < 3; ++k) within[k] += std::abs(s) <= k + 1;
    }
    const double n = static_cast<double>(mm.size()), percent_of_n = 100 / n;
    std::printf(
        "%-7s mean %6.2f mm  rms %6.2f mm  median %6.3f %%  P95 %6.3f %%  max %6.3f %%  within 1, 2, 3 "
        "sigma %5.1f %5.1f %5.1f %%  mean error %+.2f sigma\n",
        name, sum / n, std::sqrt(squares / n), quantile(percent, 0.5), quantile(percent, 0.95),
        quantile(percent, 1), within[0] * percent_of_n, within[1] * percent_of_n, within[2] * percent_of_n,
        signed_sigmas / n);
  }
};

Region regionOf(const std::string& kind, int id, const cv::Rect& outline, const cv::Mat& labels,
                cv::RNG& random) {
  const cv::Mat visible = labels == id;
  if (kind == "mask") return visible;
  if (kind == "visible") return cv::boundingRect(visible);
  if (kind == "circle")
    return Circle{{outline.x + (outline.width - 1) / 2.0, outline.y + (outline.height - 1) / 2.0},
                  std::max(outline.width, outline.height) / 2.0};
  if (kind != "box") throw std::invalid_argument("REGION is " + kind);
  const auto off = [&](int size) { return cvRound(random.uniform(-0.1, 0.1) * size); };
  return cv::Rect(outline.x + off(outline.width), outline.y + off(outline.height),
                  outline.width + off(outline.width), outline.height + off(outline.height));
}

StereoResult match(const std::string& method_name, const Scene& scene) {
  const int disparities = scene.calibration->stereo.num_disparities;
  for (const char* preset : {"fast", "balanced", "quality", "paper"})
    if (method_name == preset) {
      Options options = Options::preset(preset);
      options.num_disparities = disparities;
      return computeDisparity(scene.left, scene.right, options);
    }
  MethodOptions options;
  options.num_disparities = disparities;
  const MethodResult found = makeMethod(method_name)->run(scene.left, scene.right, options);
  StereoResult result;
  result.disparity = found.disparity;
  return result;
}

struct Totals {
  Errors near, center;
  int fruits = 0, failed = 0;
  double milliseconds = 0;
};

void measureScene(const std::string& method, const std::string& kind, const std::string& folder, bool list,
                  Totals& totals) {
  const Scene scene = readScene(folder);
  const cv::Mat labels = cv::imread(folder + "/fruits0.png", cv::IMREAD_UNCHANGED);
  const nlohmann::json fruits = nlohmann::json::parse(std::ifstream(folder + "/fruits.json"));
  const StereoResult result = match(method, scene);
  cv::RNG random(7);
  for (const auto& fruit : fruits["fruits"]) {
    if (fruit["visible_share"].get<double>() < kLeastVisible) continue;
    const auto box = fruit["box_px"].get<std::array<int, 4>>();
    const Region region = regionOf(kind, fruit["id"], {box[0], box[1], box[2], box[3]}, labels, random);
    const auto start = std::chrono::steady_clock::now();
    const ObjectMeasurement m = measureObject(result, scene.calibration->stereo, region);
    totals.milliseconds +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    ++totals.fruits;
    const double near_m = fruit["near_distance_m"], center_m = fruit["distance_m"];
    if (m.ok()) {
      totals.near.add(m.distance_m, m.distance_sigma_m, near_m);
      totals.center.add(m.center_distance_m, m.center_sigma_m, center_m);
    } else {
      ++totals.failed;
    }
    if (list)
      std::printf(
          "%s %2d visible %.2f  near %.4f m, off %+7.2f +- %5.2f mm  center %.4f m, off %+7.2f +- %5.2f mm  "
          "radius %4.1f, found %4.1f +- %4.1f mm  %d px%s%s\n",
          folder.c_str(), fruit["id"].get<int>(), fruit["visible_share"].get<double>(), near_m,
          1000 * (m.distance_m - near_m), 1000 * m.distance_sigma_m, center_m,
          1000 * (m.center_distance_m - center_m), 1000 * m.center_sigma_m,
          1000 * fruit["radius_m"].get<double>(), 1000 * m.radius_m, 1000 * m.radius_sigma_m, m.support_px,
          m.ok() ? "" : "  ", m.ok() ? "" : std::string(explain(m.failure)).c_str());
  }
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: pomona_fruits METHOD box|visible|circle|mask FOLDER...\n");
    return 2;
  }
  pomona::Totals totals;
  try {
    for (int i = 3; i < argc; ++i)
      pomona::measureScene(argv[1], argv[2], argv[i], std::getenv("POMONA_FRUITS_LIST") != nullptr, totals);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pomona_fruits: error: %s\n", e.what());
    return 1;
  }
  std::printf("%d fruits, %d not measured, %.2f ms each\n", totals.fruits, totals.failed,
              totals.milliseconds / totals.fruits);
  totals.near.print("near");
  totals.center.print("center");
}
