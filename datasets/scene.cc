#include "datasets/scene.h"

#include <filesystem>
#include <stdexcept>

#include "datasets/disparity_file.h"
#include "datasets/image_file.h"

namespace pomona {
namespace {

std::string shown(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireSize(const std::string& path, const cv::Mat& image, cv::Size size) {
  if (image.size() != size)
    throw std::runtime_error(path + ": is " + shown(image.size()) + "; the left image is " + shown(size));
}

}  // namespace

Scene readScene(const std::string& folder) {
  const auto pathOf = [&](const char* leaf) { return (std::filesystem::path(folder) / leaf).string(); };
  const auto present = [](const std::string& path) { return std::filesystem::exists(path); };

  Scene scene;
  scene.left = readImage(pathOf("im0.png"));
  const std::string right = pathOf("im1.png");
  scene.right = readImage(right);
  requireSize(right, scene.right, scene.left.size());
  if (scene.right.type() != scene.left.type())
    throw std::runtime_error(right + ": has " + describeType(scene.right) + "; the left image has " +
                             describeType(scene.left));
  if (const std::string path = pathOf("disp0GT.pfm"); present(path)) {
    scene.ground_truth = readDisparity(path);
    requireSize(path, scene.ground_truth, scene.left.size());
  }
  if (const std::string path = pathOf("mask0nocc.png"); present(path)) {
    scene.nonoccluded = readImage(path);
    requireSize(path, scene.nonoccluded, scene.left.size());
    if (scene.nonoccluded.type() != CV_8UC1)
      throw std::runtime_error(path + ": has " + describeType(scene.nonoccluded) +
                               "; allowed: 1 channel of 8 bits");
  }
  if (const std::string path = pathOf("calib.txt"); present(path))
    scene.calibration = readMiddleburyCalibration(path);
  return scene;
}

}  // namespace pomona
