#include "bench/fruits/measure_fruits.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "baselines/method.h"
#include "pomona/engine.h"
#include "pomona/measure.h"

namespace pomona {
namespace {

cv::Rect jittered(const cv::Rect& box, cv::RNG& random) {
  constexpr double kMostOff = 0.1;
  const auto off = [&](int size) { return cvRound(random.uniform(-kMostOff, kMostOff) * size); };
  return {box.x + off(box.width), box.y + off(box.height), box.width + off(box.width),
          box.height + off(box.height)};
}

// The median distance along the line of sight of the mask's pixels; NaN if fewer than half are known.
double medianDistance(const cv::Mat& disparity, const cv::Mat& mask, const StereoCalibration& c) {
  std::vector<double> distances_m;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const double parallax_px = disparity.at<float>(y, x) + c.doffs_px;
      if (mask.at<std::uint8_t>(y, x) == 0 || !(parallax_px > 0)) continue;
      const cv::Vec3d ray((x - c.cx_px) / c.focal_px, (y - c.cy_px) / c.focal_px, 1);
      distances_m.push_back(c.focal_px * c.baseline_m / parallax_px * cv::norm(ray));
    }
  if (2 * distances_m.size() < static_cast<std::size_t>(cv::countNonZero(mask))) return kNoDistance;
  return quantile(std::move(distances_m), 0.5);
}

MeasuredDistance nearSide(const ObjectMeasurement& m, double true_m) {
  return {true_m, m.distance_m, m.distance_sigma_m};
}

}  // namespace

std::vector<WaysOfOneFruit> measureFruits(const StereoResult& result, const OrchardPicture& picture,
                                          std::uint64_t seed) {
  const StereoCalibration& calibration = picture.pair.calibration;
  cv::RNG random(seed);
  std::vector<WaysOfOneFruit> measured;
  for (const PicturedFruit& fruit : picture.fruits) {
    const cv::Mat mask = picture.labels == fruit.label;
    const auto measure = [&](const Region& region) { return measureObject(result, calibration, region); };
    const double near_m = fruit.near_distance_m;
    const ObjectMeasurement by_mask = measure(mask);
    WaysOfOneFruit& ways = measured.emplace_back();
    ways[kMask] = nearSide(by_mask, near_m);
    ways[kVisible] = nearSide(measure(cv::boundingRect(mask)), near_m);
    ways[kBox] = nearSide(measure(jittered(fruit.outline_px, random)), near_m);
    ways[kCenter] = {fruit.center_distance_m, by_mask.center_distance_m, by_mask.center_sigma_m};
    ways[kMedian] = {medianDistance(picture.pair.left.disparity, mask, calibration),
                     medianDistance(result.disparity, mask, calibration), kNoDistance};
    if (result.sigma_px.empty())  // then what measureObject() claims is a guess
      for (MeasuredDistance& way : ways) way.sigma_m = kNoDistance;
  }
  return measured;
}

bool knowsSigma(const std::string& method) {
  return method == "fast" || method == "balanced" || method == "quality";
}

StereoResult mapOf(const std::string& method, const cv::Mat& left, const cv::Mat& right,
                   int num_disparities) {
  if (knowsSigma(method)) {
    Options options = Options::preset(method);
    options.num_disparities = num_disparities;
    return computeDisparity(left, right, options);
  }
  MethodOptions options;
  options.num_disparities = num_disparities;
  const MethodResult found = makeMethod(method)->run(left, right, options);
  StereoResult result;
  result.disparity = found.disparity;
  result.state = found.state;
  return result;
}

}  // namespace pomona
