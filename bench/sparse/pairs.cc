#include "bench/sparse/pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "datasets/rendering/indoor.h"
#include "datasets/walk.h"

namespace pomona {
namespace {

cv::Mat inEightBits(const cv::Mat& view) {
  if (view.depth() == CV_8U) return view;
  cv::Mat bytes;
  view.convertTo(bytes, CV_8U, 1.0 / 257);
  return bytes;
}

StereoCalibration madeUpCalibration(const cv::Mat& view, const cv::Mat& truth) {
  StereoCalibration c;
  c.focal_px = view.cols;
  c.baseline_m = 0.1;
  c.cx_px = (view.cols - 1) / 2.0;
  c.cy_px = (view.rows - 1) / 2.0;
  c.width = view.cols;
  c.height = view.rows;
  c.num_disparities = disparitiesToReach(truth);
  return c;
}

}  // namespace

std::vector<TruthPair> indoorPairs() {
  std::vector<TruthPair> pairs;
  for (const double contrast : {10.0, 14.0, 20.0, 28.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SceneDescription cameras;
      cameras.width = cameras.focal_px = 640;
      cameras.height = 480;
      cameras.baseline_m = 0.12;
      IndoorOptions options;
      options.seed = seed;
      options.contrast = contrast;
      CameraEffects effects;
      effects.blur_px = 0.5;
      effects.shot_noise = effects.read_noise = 1;
      effects.noise_seed = seed;
      const RenderedPair pair = render(indoor(cameras, options).scene, effects);
      pairs.push_back({cv::format("room %d, contrast %g", static_cast<int>(seed), contrast), pair.left.image,
                       pair.right.image, pair.left.disparity, pair.calibration});
    }
  return pairs;
}

std::vector<TruthPair> realPairs(const std::string& folder) {
  std::vector<TruthPair> pairs;
  if (folder.empty()) return pairs;
  for (const SceneFiles& files : findScenes({folder})) {
    const Scene scene = readScene(files);
    if (scene.ground_truth.empty()) continue;
    TruthPair pair{files.name, inEightBits(scene.left), inEightBits(scene.right), scene.ground_truth,
                   madeUpCalibration(scene.left, scene.ground_truth)};
    if (scene.calibration) pair.calibration = scene.calibration->stereo;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

float truthAt(const cv::Mat& truth, cv::Point2f left_px) {
  const cv::Point pixel(cvRound(left_px.x), cvRound(left_px.y));
  const bool inside = cv::Rect({}, truth.size()).contains(pixel);
  return inside ? truth.at<float>(pixel) : std::numeric_limits<float>::quiet_NaN();
}

void PointAccuracy::add(float disparity_px, float true_px) {
  if (std::isnan(true_px)) return;
  ++known;
  const float error_px = std::abs(disparity_px - true_px);
  right += error_px <= 1;  // what is not known (NaN) is not right
  errors_px.push_back(std::isnan(error_px) ? std::numeric_limits<float>::infinity() : error_px);
}

void PointAccuracy::add(const PointAccuracy& other) {
  known += other.known;
  right += other.right;
  errors_px.insert(errors_px.end(), other.errors_px.begin(), other.errors_px.end());
}

double PointAccuracy::medianPx() const {
  return medianOf({errors_px.begin(), errors_px.end()});
}

PointAccuracy accuracyOf(const std::vector<SparsePoint>& points, const cv::Mat& truth) {
  PointAccuracy accuracy;
  for (const SparsePoint& p : points) accuracy.add(p.disparity_px, truthAt(truth, p.left_px));
  return accuracy;
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pomona
