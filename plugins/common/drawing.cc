#include "plugins/common/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "datasets/colorize.h"

namespace pomona {
namespace {

const cv::Scalar kWhite(255, 255, 255), kBlack(0, 0, 0);
constexpr int kFractionBits = 4;  // OpenCV draws at sixteenths of a pixel

cv::Point subpixel(cv::Point2f p) {
  const auto fixed = [](float v) { return cvRound(std::ldexp(v, kFractionBits)); };
  return {fixed(p.x), fixed(p.y)};
}

/// CV_8UC3, one pixel per point.
cv::Mat pointColors(const std::vector<SparsePoint>& points) {
  cv::Mat disparities(1, static_cast<int>(points.size()), CV_32F);
  for (int i = 0; i < disparities.cols; ++i) disparities.at<float>(i) = points[i].disparity_px;
  return colorizeDisparity(disparities, typicalRange(disparities));
}

void drawPoints(cv::Mat& picture, const std::vector<SparsePoint>& points, int scale) {
  if (points.empty()) return;
  const cv::Mat colors = pointColors(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    cv::circle(picture, subpixel(points[i].left_px), (2 * scale) << kFractionBits,
               colors.at<cv::Vec3b>(static_cast<int>(i)), cv::FILLED, cv::LINE_AA, kFractionBits);
}

std::vector<cv::Point2f> outlineOf(const SparseObject& object) {
  const cv::Rect2f& b = object.box_px;
  if (!object.outline_px.empty() || b.empty()) return object.outline_px;
  return {b.tl(), {b.x + b.width, b.y}, b.br(), {b.x, b.y + b.height}};
}

std::string captionOf(const SparseObject& object) {
  std::array<char, 32> distance{};
  if (std::isfinite(object.distance_m))
    std::snprintf(distance.data(), distance.size(), " %.2f m", object.distance_m);
  return object.label + distance.data();
}

/// White on a black border, so that it can be read on anything, and inside of the picture.
void drawText(cv::Mat& picture, const std::string& text, cv::Point at, int scale) {
  const double size = 0.5 * scale;
  int below = 0;
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, scale, &below);
  at.x = std::clamp(at.x, 0, std::max(0, picture.cols - extent.width));
  at.y = std::clamp(at.y, extent.height, std::max(extent.height, picture.rows - below));
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kBlack, 3 * scale, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kWhite, scale, cv::LINE_AA);
}

void drawObject(cv::Mat& picture, const SparseObject& object, int scale) {
  const std::vector<cv::Point2f> outline = outlineOf(object);
  if (outline.empty()) return;
  std::vector<cv::Point> corners;
  for (const cv::Point2f corner : outline) corners.push_back(subpixel(corner));
  cv::polylines(picture, corners, true, kBlack, 3 * scale, cv::LINE_AA, kFractionBits);
  cv::polylines(picture, corners, true, kWhite, scale, cv::LINE_AA, kFractionBits);
  const auto higher = [](cv::Point2f a, cv::Point2f b) { return a.y < b.y; };
  const cv::Point2f top = *std::min_element(outline.begin(), outline.end(), higher);
  drawText(picture, captionOf(object), {cvRound(top.x), cvRound(top.y) - 4 * scale}, scale);
}

}  // namespace

cv::Mat drawSparse(const cv::Mat& left, const SparseResult& result) {
  cv::Mat gray = left, picture;
  if (left.channels() == 3) cv::cvtColor(left, gray, cv::COLOR_BGR2GRAY);
  cv::cvtColor(gray / 2, picture, cv::COLOR_GRAY2BGR);
  const int scale = std::max(1, picture.cols / 900);
  drawPoints(picture, result.points, scale);
  for (const SparseObject& object : result.objects)
    if (object.found()) drawObject(picture, object, scale);
  return picture;
}

}  // namespace pomona
