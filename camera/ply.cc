#include "camera/ply.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "camera/triangulate.h"

namespace pomona {
namespace {

void appendFloat(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift));
}

}  // namespace

std::string encodePly(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration) {
  requireMatching(disparity, calibration);
  if (colors.type() != CV_8UC3 || colors.size() != disparity.size())
    throw std::invalid_argument("colors must be CV_8UC3 and of the disparity map's size");

  std::string vertices;
  std::size_t count = 0;
  for (int y = 0; y < disparity.rows; ++y)
    for (int x = 0; x < disparity.cols; ++x) {
      const double depth_m = depthAt(disparity.at<float>(y, x), calibration);
      if (!std::isfinite(depth_m)) continue;
      const cv::Vec3d point = pointAt(x, y, depth_m, calibration);
      for (int axis = 0; axis < 3; ++axis) appendFloat(vertices, point[axis]);
      const auto& bgr = colors.at<cv::Vec3b>(y, x);
      for (int channel = 2; channel >= 0; --channel) vertices.push_back(static_cast<char>(bgr[channel]));
      ++count;
    }
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" +
         vertices;
}

}  // namespace pomona
