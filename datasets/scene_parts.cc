#include "datasets/scene_parts.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "datasets/disparity_file.h"
#include "datasets/image_file.h"

namespace pomona {
namespace {

std::string shown(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireSize(const std::string& path, cv::Size size, cv::Size left, const char* is = "is ") {
  if (size != left)
    throw std::runtime_error(path + ": " + is + shown(size) + "; the left image is " + shown(left));
}

cv::Mat readView(const std::string& path) {
  cv::Mat view = readImage(path);
  const bool usable =
      (view.depth() == CV_8U || view.depth() == CV_16U) && (view.channels() == 1 || view.channels() == 3);
  if (!usable)
    throw std::runtime_error(path + ": has " + describeType(view) +
                             "; allowed: 1 or 3 channels of 8 or 16 bits");
  return view;
}

[[noreturn]] void failOnDisparity(const std::string& path, int x, int y, float d, float most) {
  std::ostringstream text;
  text << path << ": disparity at x " << x << ", y " << y << " is " << d << "; allowed: up to " << most
       << ", 4 times the width";
  throw std::runtime_error(text.str());
}

}  // namespace

std::pair<cv::Mat, cv::Mat> readViews(const std::string& left_path, const std::string& right_path) {
  cv::Mat left = readView(left_path), right = readView(right_path);
  requireSize(right_path, right.size(), left.size());
  if (right.type() != left.type())
    throw std::runtime_error(right_path + ": has " + describeType(right) + "; the left image has " +
                             describeType(left));
  return {std::move(left), std::move(right)};
}

cv::Mat readByteMap(const std::string& path, cv::Size left) {
  cv::Mat map = readImage(path);
  requireSize(path, map.size(), left);
  if (map.type() != CV_8UC1)
    throw std::runtime_error(path + ": has " + describeType(map) + "; allowed: 1 channel of 8 bits");
  return map;
}

cv::Mat readTruth(const std::string& path, cv::Size left) {
  cv::Mat truth = readDisparity(path);
  requireSize(path, truth.size(), left);
  const float most = 4.0f * static_cast<float>(left.width);
  bool any = false;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      const float d = truth.at<float>(y, x);
      any |= !std::isnan(d);
      if (std::abs(d) > most) failOnDisparity(path, x, y, d, most);
    }
  if (!any) throw std::runtime_error(path + ": holds no known disparity");
  return truth;
}

void requireCalibrationFits(const std::string& path, const StereoCalibration& calibration, cv::Size left) {
  const cv::Size stated(calibration.width, calibration.height);
  if (!stated.empty()) requireSize(path, stated, left, "is for images of ");
}

MiddleburyCalibration readCalibration(const std::string& path, cv::Size left) {
  MiddleburyCalibration calibration = readMiddleburyCalibration(path);
  requireCalibrationFits(path, calibration.stereo, left);
  return calibration;
}

}  // namespace pomona
