#include "datasets/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "datasets/scene_parts.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

// Steps per pixel of an 8-bit truth. The files do not say; see readScene() in the header.
int stepsPerPixel(const SceneFiles& files, int width) {
  constexpr std::array<std::string_view, 7> kPlanar = {"barn1",  "barn2",    "bull", "map",
                                                       "poster", "sawtooth", "venus"};
  constexpr double kWidth2003 = 1800, kWidth2005 = 1300;
  const fs::path left = fs::absolute(files.left).lexically_normal();  // from within, its folder is "."
  const std::string scene = lowerCase(left.parent_path().filename().string());
  if (scene == "tsukuba") return 16;
  if (std::find(kPlanar.begin(), kPlanar.end(), scene) != kPlanar.end()) return 8;
  const bool views = left.stem() == "view1";
  const double reduction = (views ? kWidth2005 : kWidth2003) / width;
  return std::clamp(static_cast<int>(std::lround(reduction)), 1, views ? 3 : 4);
}

cv::Mat readTruthOf(const SceneFiles& files, cv::Size size) {
  if (files.layout != SceneLayout::kMiddlebury2) return readTruth(files.ground_truth, size);
  cv::Mat truth;
  const cv::Mat steps = readByteMap(files.ground_truth, size);
  steps.convertTo(truth, CV_32F, 1.0 / stepsPerPixel(files, size.width));
  truth.setTo(std::numeric_limits<float>::quiet_NaN(), steps == 0);
  if (cv::countNonZero(steps) == 0)
    throw std::runtime_error(files.ground_truth + ": holds no known disparity");
  return truth;
}

cv::Mat readNonoccluded(const SceneFiles& files, const Scene& scene) {
  if (files.layout != SceneLayout::kKitti2012 && files.layout != SceneLayout::kKitti2015)
    return readByteMap(files.nonoccluded, scene.left.size());
  const cv::Mat seen_by_both = readTruth(files.nonoccluded, scene.left.size());
  cv::Mat mask(scene.left.size(), CV_8U, cv::Scalar(0));
  if (!scene.ground_truth.empty())
    mask.setTo(128, scene.ground_truth == scene.ground_truth);  // false for NaN
  mask.setTo(255, seen_by_both == seen_by_both);
  return mask;
}

}  // namespace

Scene readScene(const SceneFiles& files) {
  if (!files.problem.empty()) throw std::runtime_error(files.problem);
  Scene scene;
  std::tie(scene.left, scene.right) = readViews(files.left, files.right);
  if (!files.ground_truth.empty()) scene.ground_truth = readTruthOf(files, scene.left.size());
  if (!files.nonoccluded.empty()) scene.nonoccluded = readNonoccluded(files, scene);
  if (!files.objects.empty()) scene.objects = readByteMap(files.objects, scene.left.size());
  if (!files.calibration.empty()) scene.calibration = readCalibration(files.calibration, scene.left.size());
  return scene;
}

int disparitiesToReach(const cv::Mat& ground_truth) {
  constexpr int kMargin = 4, kMultiple = 16;
  float largest = -1;
  for (int y = 0; y < ground_truth.rows; ++y)
    for (int x = 0; x < ground_truth.cols; ++x)
      largest = std::fmax(largest, ground_truth.at<float>(y, x));  // fmax passes over NaN
  if (largest < 0) return 0;
  largest = std::fmin(largest, static_cast<float>(ground_truth.cols));
  const int needed = static_cast<int>(std::ceil(largest)) + kMargin;
  return std::min((needed + kMultiple - 1) / kMultiple * kMultiple, ground_truth.cols);
}

SceneFiles middleburyFiles(const std::string& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal() / "";
  const auto pathOf = [&](const char* leaf) { return (fs::path(folder) / leaf).string(); };
  const auto ifThere = [&](const char* leaf) {
    return fs::exists(pathOf(leaf)) ? pathOf(leaf) : std::string();
  };
  SceneFiles files;
  files.name = path.parent_path().filename().string();
  files.folder = path.parent_path().parent_path().string();
  files.left = pathOf("im0.png");
  files.right = pathOf("im1.png");
  files.ground_truth = ifThere("disp0GT.pfm");
  if (files.ground_truth.empty()) files.ground_truth = ifThere("disp0.pfm");  // its name in the 2014 sets
  files.nonoccluded = ifThere("mask0nocc.png");
  files.calibration = ifThere("calib.txt");
  return files;
}

Scene readScene(const std::string& folder) {
  return readScene(middleburyFiles(folder));
}

}  // namespace pomona
