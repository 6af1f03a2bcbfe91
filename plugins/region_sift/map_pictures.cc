#include "plugins/region_sift/map_pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

namespace pomona {
namespace {

constexpr int kWidth = 720, kMostHeight = 720, kMargin = 40;

struct Range {
  double low, high;
};

// From the 2nd to the 98th percentile, and some room: a few wrong points shall not shrink all others.
Range rangeOf(const std::vector<cv::Point3f>& points, const std::function<double(const cv::Point3f&)>& axis) {
  std::vector<double> values;
  for (const cv::Point3f& p : points) values.push_back(axis(p));
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[static_cast<std::size_t>(share * (values.size() - 1))]; };
  const double room = 0.05 * (at(0.98) - at(0.02)) + 0.1;
  return {at(0.02) - room, at(0.98) + room};
}

// A drawing in metres, of one scale in both directions.
class MetricCanvas {
 public:
  MetricCanvas(Range x, Range y, const char* x_name, const char* y_name) : x_(x), y_(y) {
    const double width_m = x.high - x.low, height_m = y.high - y.low;
    px_per_m_ = std::min((kWidth - 2 * kMargin) / width_m, (kMostHeight - 2 * kMargin) / height_m);
    image_.create(at({x.low, y.low}).y + kMargin, at({x.high, y.low}).x + kMargin, CV_8UC3);
    image_.setTo(cv::Scalar::all(255));
    const double step_m = gridStepM();
    for (int i = cvCeil(x.low / step_m); i * step_m <= x.high; ++i) {
      line({i * step_m, y.low}, {i * step_m, y.high});
      text(cv::format("%g", i * step_m), at({i * step_m, y.low}) + cv::Point(-8, 16));
    }
    for (int i = cvCeil(y.low / step_m); i * step_m <= y.high; ++i) {
      line({x.low, i * step_m}, {x.high, i * step_m});
      text(cv::format("%g", i * step_m), at({x.low, i * step_m}) + cv::Point(-34, 4));
    }
    text(y_name, {4, 16});
    text(x_name, {image_.cols - 44, image_.rows - 8});
  }

  void point(double x_m, double y_m, const cv::Scalar& color) {
    if (x_m < x_.low || x_m > x_.high || y_m < y_.low || y_m > y_.high) return;
    cv::circle(image_, at({x_m, y_m}), 2, color, cv::FILLED, cv::LINE_AA);
  }
  cv::Mat image() const { return image_; }

 private:
  double gridStepM() const {
    constexpr double kLeastStep_px = 40;
    for (const double step_m : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0})
      if (step_m * px_per_m_ >= kLeastStep_px) return step_m;
    return std::ceil(kLeastStep_px / px_per_m_);
  }
  cv::Point at(cv::Point2d p_m) const {
    return {cvRound(kMargin + (p_m.x - x_.low) * px_per_m_),
            cvRound(kMargin + (y_.high - p_m.y) * px_per_m_)};
  }
  void line(cv::Point2d from_m, cv::Point2d to_m) {
    cv::line(image_, at(from_m), at(to_m), cv::Scalar::all(215), 1);
  }
  void text(const std::string& words, cv::Point where) {
    cv::putText(image_, words, where, cv::FONT_HERSHEY_SIMPLEX, 0.4, cv::Scalar::all(70), 1, cv::LINE_AA);
  }

  Range x_, y_;
  double px_per_m_ = 1;
  cv::Mat image_;
};

// Blue is far, red is near.
class DepthColors {
 public:
  explicit DepthColors(const Range& depth) : depth_(depth) {
    cv::Mat shares(1, 256, CV_8U);
    for (int i = 0; i < 256; ++i) shares.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
    cv::applyColorMap(shares, colors_, cv::COLORMAP_JET);
  }
  cv::Scalar at(double z_m) const {
    const double share = std::clamp((depth_.high - z_m) / (depth_.high - depth_.low), 0.0, 1.0);
    return colors_.at<cv::Vec3b>(cvRound(255 * share));
  }

 private:
  Range depth_;
  cv::Mat colors_;
};

}  // namespace

std::vector<SparsePicture> mapPictures(const std::vector<SparsePoint>& points, double camera_height_m) {
  std::vector<cv::Point3f> known;
  for (const SparsePoint& p : points)
    if (std::isfinite(p.point_m.z)) known.push_back(p.point_m);
  if (known.empty()) return {};
  const auto x = [](const cv::Point3f& p) -> double { return p.x; };
  const auto height = [&](const cv::Point3f& p) { return camera_height_m - p.y; };
  const auto depth = [](const cv::Point3f& p) -> double { return p.z; };
  const Range xs = rangeOf(known, x), heights = rangeOf(known, height), depths = rangeOf(known, depth);
  MetricCanvas front(xs, {std::min(-0.1, heights.low), heights.high}, "X, m", "height, m");
  MetricCanvas top(xs, {0, depths.high}, "X, m", "Z, m");
  // From far to near, so that the near ones cover the others as they do in the view.
  std::sort(known.begin(), known.end(), [](auto& a, auto& b) { return a.z > b.z; });
  const DepthColors colors(depths);
  for (const cv::Point3f& p : known) {
    const cv::Scalar color = colors.at(p.z);
    front.point(p.x, height(p), color);
    top.point(p.x, p.z, color);
  }
  return {{"map-front", front.image()}, {"map-top", top.image()}};
}

}  // namespace pomona
