#include "datasets/png16.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "datasets/image_file.h"

namespace pomona {
namespace {

constexpr double kLargest = 65535;

void requireFloatMap(const cv::Mat& map, const char* name) {
  if (map.empty() || map.type() != CV_32FC1)
    throw std::invalid_argument(std::string(name) + " must be CV_32FC1 and not empty");
}

}  // namespace

std::string encodeDisparityPng(const cv::Mat& disparity, int scale) {
  requireFloatMap(disparity, "disparity");
  cv::Mat steps(disparity.size(), CV_16UC1);
  for (int y = 0; y < disparity.rows; ++y)
    for (int x = 0; x < disparity.cols; ++x) {
      const float d = disparity.at<float>(y, x);
      double step = 0;
      if (!std::isnan(d)) {
        step = std::max(1.0, std::floor(double{d} * scale + 0.5));
        if (d < 0 || step > kLargest)
          throw std::invalid_argument("disparity at x " + std::to_string(x) + ", y " + std::to_string(y) +
                                      " is " + std::to_string(d) + "; a 16-bit PNG of 1/" +
                                      std::to_string(scale) + " px holds 0 to " +
                                      std::to_string(kLargest / scale) + " (use .pfm)");
      }
      steps.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(step);
    }
  return encodeImage(steps);
}

cv::Mat readDisparityPng(const std::string& path, int scale) {
  const cv::Mat steps = readImage(path);
  if (steps.type() != CV_16UC1)
    throw std::runtime_error(path + ": expected 16 bits and 1 channel, found " + describeType(steps));
  cv::Mat disparity(steps.size(), CV_32FC1);
  for (int y = 0; y < steps.rows; ++y)
    for (int x = 0; x < steps.cols; ++x) {
      const int step = steps.at<std::uint16_t>(y, x);
      disparity.at<float>(y, x) = step == 0 ? std::numeric_limits<float>::quiet_NaN()
                                            : static_cast<float>(step) / static_cast<float>(scale);
    }
  return disparity;
}

std::string encodeDepthPng(const cv::Mat& depth_m) {
  requireFloatMap(depth_m, "depth");
  cv::Mat millimetres(depth_m.size(), CV_16UC1);
  for (int y = 0; y < depth_m.rows; ++y)
    for (int x = 0; x < depth_m.cols; ++x) {
      const double mm = std::floor(1000.0 * depth_m.at<float>(y, x) + 0.5);
      millimetres.at<std::uint16_t>(y, x) = mm > 0 && mm <= kLargest ? static_cast<std::uint16_t>(mm) : 0;
    }
  return encodeImage(millimetres);
}

}  // namespace pomona
