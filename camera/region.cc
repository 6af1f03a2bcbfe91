#include "camera/region.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <type_traits>

namespace pomona {
namespace {

// Coordinates far beyond any image are a mistake, and would not fit into an int.
constexpr double kFarthest_px = 1e6;

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("region: ") + what);
}

bool isPlausible(const cv::Point2d& p) {
  return std::abs(p.x) < kFarthest_px && std::abs(p.y) < kFarthest_px;  // false for NaN
}

Outline outlineOfBounds(double left, double top, double right, double bottom) {
  return {{(left + right) / 2, (top + bottom) / 2}, std::max(right - left, bottom - top) / 2};
}

Outline outlineOfShape(const cv::Rect& box, cv::Size) {
  require(box.width > 0 && box.height > 0, "the box is empty");
  require(isPlausible(box.tl()) && isPlausible(box.br()), "the box is out of any image");
  return outlineOfBounds(box.x - 0.5, box.y - 0.5, box.x + box.width - 0.5, box.y + box.height - 0.5);
}

Outline outlineOfShape(const Circle& circle, cv::Size) {
  require(isPlausible(circle.center_px), "the circle's centre is not a number, or out of any image");
  require(circle.radius_px > 0, "the circle's radius must be above 0");
  require(circle.radius_px < kFarthest_px, "the circle is larger than any image");
  return {circle.center_px, circle.radius_px};
}

Outline outlineOfShape(const Polygon& corners, cv::Size) {
  require(corners.size() >= 3, "a polygon has at least three corners");
  require(std::all_of(corners.begin(), corners.end(), isPlausible),
          "a corner is not a number, or out of any image");
  const auto [left, right] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](const auto& a, const auto& b) { return a.y < b.y; });
  const Outline outline = outlineOfBounds(left->x, top->y, right->x, bottom->y);
  require(outline.radius_px > 0, "the polygon is a point");
  return outline;
}

Outline outlineOfShape(const cv::Mat& mask, cv::Size image) {
  require(mask.type() == CV_8UC1 && mask.size() == image, "the mask must be CV_8UC1 and of the image's size");
  const cv::Rect box = cv::boundingRect(mask);
  require(!box.empty(), "the mask is 0 everywhere");
  return outlineOfShape(box, image);
}

cv::Mat1b insideOf(const Circle& circle, const cv::Rect& box) {
  cv::Mat1b inside(box.size());
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const cv::Point2d offset = cv::Point2d(box.x + x, box.y + y) - circle.center_px;
      inside(y, x) = offset.dot(offset) <= circle.radius_px * circle.radius_px ? 255 : 0;
    }
  return inside;
}

cv::Mat1b insideOf(const Polygon& corners, const cv::Rect& box) {
  constexpr int kFractionBits = 8;
  std::vector<cv::Point> fixed;
  for (const cv::Point2d& p : corners) fixed.push_back((p - cv::Point2d(box.tl())) * (1 << kFractionBits));
  cv::Mat1b inside(box.size(), 0);
  cv::fillPoly(inside, std::vector<std::vector<cv::Point>>{fixed}, 255, cv::LINE_8, kFractionBits);
  return inside;
}

}  // namespace

Outline outlineOf(const Region& region, cv::Size image) {
  return std::visit([&](const auto& shape) { return outlineOfShape(shape, image); }, region);
}

RegionMask maskOf(const Region& region, cv::Size image) {
  const Outline outline = outlineOf(region, image);
  const auto toInt = [](double v) { return static_cast<int>(std::lround(v)); };
  RegionMask mask;
  std::visit(
      [&](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        const cv::Rect all({}, image);
        if constexpr (std::is_same_v<Shape, cv::Rect>) {
          mask.box = shape & all;
          mask.inside = cv::Mat1b(mask.box.size(), 255);
        } else if constexpr (std::is_same_v<Shape, cv::Mat>) {
          mask.box = cv::boundingRect(shape);
          mask.inside = shape(mask.box);
        } else {
          const double r = outline.radius_px + 1;
          mask.box = cv::Rect(toInt(outline.center_px.x - r), toInt(outline.center_px.y - r),
                              toInt(2 * r) + 1, toInt(2 * r) + 1) &
                     all;
          mask.inside = insideOf(shape, mask.box);
        }
      },
      region);
  mask.pixels = mask.box.empty() ? 0 : cv::countNonZero(mask.inside);
  return mask;
}

RegionSamples samplesOf(const StereoResult& result, const StereoCalibration& calibration,
                        const Outline& outline, const RegionMask& mask, int most) {
  constexpr double kDecline = 1.6;        // exp(-1.6) = 0.2
  constexpr double kUsualSigma_px = 0.3;  // where the result knows none
  constexpr double kTrustInFilled = 0.25;
  const int step =
      std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(mask.pixels) / most))));
  RegionSamples out;
  out.pixels_each = step * step;
  out.view_width_px = result.disparity.cols;
  out.samples.reserve(static_cast<std::size_t>(mask.pixels / out.pixels_each * 1.2 + 16));
  for (int row = 0; row < mask.box.height; ++row)
    for (int column = 0; column < mask.box.width; ++column) {
      if (mask.inside(row, column) == 0) continue;
      const int y = mask.box.y + row, x = mask.box.x + column;
      const float d = result.disparity.at<float>(y, x);
      const bool known = std::isfinite(d);
      const double parallax_px = d + calibration.doffs_px;
      out.known_px += known;
      out.infinite_px += known && parallax_px <= 0;
      if (row % step != step / 2 || column % step != step / 2) continue;
      const cv::Vec3d line((x - calibration.cx_px) / calibration.focal_px,
                           (y - calibration.cy_px) / calibration.focal_px, 1);
      const cv::Vec3d ray = line * (1 / cv::norm(line));
      const cv::Point2d offset = (cv::Point2d(x, y) - outline.center_px) * (1 / outline.radius_px);
      const double centrality = std::exp(-kDecline * offset.dot(offset));
      const PixelState state = result.state.empty() ? PixelState::kMeasured : result.stateAt(y, x);
      const bool measured = known && isMeasured(state);
      if (!measured && state != PixelState::kMasked) out.unmeasured.push_back({ray, double(x), centrality});
      if (!known || parallax_px <= 0) continue;
      const double sigma_px = result.sigma_px.empty() ? kUsualSigma_px : result.sigma_px.at<float>(y, x);
      const double confidence = result.confidence.empty() ? 1 : result.confidence.at<float>(y, x);
      const double trust = confidence * (measured ? 1 : kTrustInFilled);
      out.samples.push_back({ray, double(x), double(y), parallax_px, sigma_px, trust, centrality,
                             trust * centrality, measured});
    }
  return out;
}

}  // namespace pomona
