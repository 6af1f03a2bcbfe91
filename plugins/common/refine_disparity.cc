#include "plugins/common/refine_disparity.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

float dot(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<float>(a.dot(b));
}

cv::Mat windowAround(const cv::Mat& view, cv::Point2f middle, cv::Size size) {
  cv::Mat window;
  cv::getRectSubPix(view, size, middle, window, CV_32F);
  return window;
}

cv::Mat withoutMean(const cv::Mat& window) {
  return window - cv::mean(window);
}

bool holdsWindow(const cv::Mat& view, cv::Point2f middle, float reach_px) {
  return middle.x >= reach_px && middle.x <= static_cast<float>(view.cols - 1) - reach_px &&
         middle.y >= reach_px && middle.y <= static_cast<float>(view.rows - 1) - reach_px;
}

}  // namespace

RefinedDisparity refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Point2f left_px,
                                 float disparity_px, const RefineOptions& options) {
  constexpr int kIterations = 8;
  constexpr float kSmallStep_px = 0.005f, kLeastEnergyPerPixel = 0.02f;
  const auto reach_px = static_cast<float>(options.radius_px + 1);
  if (!holdsWindow(left, left_px, reach_px)) return {};
  const int side = 2 * options.radius_px + 1;
  const cv::Size size(side, side);
  const cv::Mat wide = windowAround(left, left_px, {side + 2, side});
  const cv::Mat window = withoutMean(wide.colRange(1, side + 1));
  const cv::Mat gradient = withoutMean(0.5 * (wide.colRange(2, side + 2) - wide.colRange(0, side)));
  const float pixels = static_cast<float>(side * side), gradient_energy = dot(gradient, gradient);
  if (gradient_energy < kLeastEnergyPerPixel * pixels) return {};

  RefinedDisparity refined{false, disparity_px, 0, 0};
  cv::Mat other;
  for (int i = 0; i < kIterations; ++i) {
    const cv::Point2f right_px(left_px.x - refined.disparity_px, left_px.y);
    if (!holdsWindow(right, right_px, reach_px)) return {};
    other = withoutMean(windowAround(right, right_px, size));
    // left(x) = right(x - d) once d is right; a d too large by e shows left(x - e) = left(x) - e left'(x).
    const float step = dot(gradient, other - window) / gradient_energy;
    if (std::abs(step) < kSmallStep_px) break;
    refined.disparity_px += step;
    if (std::abs(refined.disparity_px - disparity_px) > options.max_step_px) return {};
  }
  const float energy = dot(window, window), other_energy = dot(other, other), common = dot(window, other);
  if (energy <= 0 || other_energy <= 0) return {};
  refined.correlation = common / std::sqrt(energy * other_energy);
  const float left_over = std::max(0.f, energy + other_energy - 2 * common);
  // Half a grey value of rounding in each view is there even if nothing is left over.
  const float variance = std::max(left_over / pixels, 1 / 6.f);
  refined.sigma_px = std::sqrt(variance / gradient_energy);
  refined.ok = refined.correlation >= options.min_correlation;
  return refined;
}

}  // namespace pomona
