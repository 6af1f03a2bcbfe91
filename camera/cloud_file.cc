#include "camera/cloud_file.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace pomona {
namespace {

void append(std::string& bytes, std::uint32_t little_endian) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(little_endian >> shift));
}

void append(std::string& bytes, const cv::Vec3f& point) {
  for (int axis = 0; axis < 3; ++axis) append(bytes, std::bit_cast<std::uint32_t>(point[axis]));
}

void appendVertex(std::string& bytes, const cv::Vec3f& point, const cv::Vec3b& bgr) {
  append(bytes, point);
  for (int channel = 2; channel >= 0; --channel) bytes.push_back(static_cast<char>(bgr[channel]));
}

std::string plyOf(std::size_t count, const std::string& vertices) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" +
         vertices;
}

cv::Mat pointsOf(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration) {
  cv::Mat points = pointsFromDisparity(disparity, calibration);
  if (colors.type() != CV_8UC3 || colors.size() != disparity.size())
    throw std::invalid_argument("colors must be CV_8UC3 and of the disparity map's size");
  return points;
}

}  // namespace

std::string encodePly(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration) {
  const cv::Mat points = pointsOf(disparity, colors, calibration);
  std::string vertices;
  std::size_t count = 0;
  for (int y = 0; y < points.rows; ++y)
    for (int x = 0; x < points.cols; ++x) {
      const auto& point = points.at<cv::Vec3f>(y, x);
      if (!std::isfinite(point[2])) continue;
      appendVertex(vertices, point, colors.at<cv::Vec3b>(y, x));
      ++count;
    }
  return plyOf(count, vertices);
}

std::string encodePlyPoints(std::span<const CloudPoint> points) {
  std::string vertices;
  for (const auto& [point_m, bgr] : points) appendVertex(vertices, point_m, bgr);
  return plyOf(points.size(), vertices);
}

std::string encodePcd(const cv::Mat& disparity, const cv::Mat& colors, const StereoCalibration& calibration) {
  const cv::Mat points = pointsOf(disparity, colors, calibration);
  std::string bytes =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F "
      "F\n"
      "COUNT 1 1 1 1\nWIDTH " +
      std::to_string(points.cols) + "\nHEIGHT " + std::to_string(points.rows) +
      "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points.total()) + "\nDATA binary\n";
  bytes.reserve(bytes.size() + 16 * points.total());
  for (int y = 0; y < points.rows; ++y)
    for (int x = 0; x < points.cols; ++x) {
      append(bytes, points.at<cv::Vec3f>(y, x));
      const auto& bgr = colors.at<cv::Vec3b>(y, x);
      append(bytes, static_cast<std::uint32_t>(bgr[2] << 16 | bgr[1] << 8 | bgr[0]));
    }
  return bytes;
}

}  // namespace pomona
