#include "plugins/common/refine_disparity.h"

#include <cmath>
#include <vector>

namespace pomona {
namespace {

// A window of the left view, its mean taken off, and its horizontal gradient.
struct Window {
  std::vector<float> value, gradient;
  float energy = 0, gradient_energy = 0;
};

float meanOf(const std::vector<float>& values) {
  float sum = 0;
  for (const float v : values) sum += v;
  return sum / static_cast<float>(values.size());
}

void subtractMean(std::vector<float>& values) {
  const float mean = meanOf(values);
  for (float& v : values) v -= mean;
}

float dot(const std::vector<float>& a, const std::vector<float>& b) {
  float sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Window windowOf(const cv::Mat& left, cv::Point middle, int radius) {
  Window window;
  for (int y = middle.y - radius; y <= middle.y + radius; ++y) {
    const std::uint8_t* row = left.ptr(y);
    for (int x = middle.x - radius; x <= middle.x + radius; ++x) {
      window.value.push_back(row[x]);
      window.gradient.push_back(0.5f * static_cast<float>(row[x + 1] - row[x - 1]));
    }
  }
  subtractMean(window.value);
  subtractMean(window.gradient);
  window.energy = dot(window.value, window.value);
  window.gradient_energy = dot(window.gradient, window.gradient);
  return window;
}

// The right view's window, `disparity_px` to the left, its mean taken off; false if it leaves the view.
bool sample(const cv::Mat& right, cv::Point middle, float disparity_px, int radius, std::vector<float>& values) {
  const float first = static_cast<float>(middle.x - radius) - disparity_px;
  const int x0 = cvFloor(first);
  const float share = first - static_cast<float>(x0);
  if (x0 < 0 || x0 + 2 * radius + 1 >= right.cols) return false;
  values.clear();
  for (int y = middle.y - radius; y <= middle.y + radius; ++y) {
    const std::uint8_t* row = right.ptr(y) + x0;
    for (int i = 0; i <= 2 * radius; ++i)
      values.push_back((1 - share) * static_cast<float>(row[i]) + share * static_cast<float>(row[i + 1]));
  }
  subtractMean(values);
  return true;
}

}  // namespace

RefinedDisparity refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Point2f left_px,
                                 float disparity_px, const RefineOptions& options) {
  constexpr int kIterations = 8;
  constexpr float kSmallStep_px = 0.005f, kLeastEnergyPerPixel = 0.02f;
  const int radius = options.radius_px;
  const cv::Point middle(cvRound(left_px.x), cvRound(left_px.y));
  if (middle.x < radius + 1 || middle.x + radius + 1 >= left.cols || middle.y < radius ||
      middle.y + radius >= left.rows)
    return {};
  const Window window = windowOf(left, middle, radius);
  const auto pixels = static_cast<float>(window.value.size());
  if (window.gradient_energy < kLeastEnergyPerPixel * pixels) return {};

  RefinedDisparity refined{false, disparity_px, 0, 0};
  std::vector<float> other;
  float step = 1;
  for (int i = 0; i < kIterations && std::abs(step) > kSmallStep_px; ++i) {
    if (!sample(right, middle, refined.disparity_px, radius, other)) return {};
    // left(x) = right(x - d) once d is right; moving d by `step` changes right(x - d) by -step times its slope.
    step = (dot(window.gradient, other) - dot(window.gradient, window.value)) / window.gradient_energy;
    refined.disparity_px += step;
    if (std::abs(refined.disparity_px - disparity_px) > options.max_step_px) return {};
  }
  if (!sample(right, middle, refined.disparity_px, radius, other)) return {};
  const float other_energy = dot(other, other), common = dot(window.value, other);
  if (other_energy <= 0 || window.energy <= 0) return {};
  refined.correlation = common / std::sqrt(other_energy * window.energy);
  const float left_over = std::max(0.f, window.energy + other_energy - 2 * common);
  // Half a grey value of rounding in each view is there even if nothing is left over.
  const float variance = std::max(left_over / pixels, 1 / 6.f);
  refined.sigma_px = std::sqrt(variance / window.gradient_energy);
  refined.ok = refined.correlation >= options.min_correlation;
  return refined;
}

}  // namespace pomona
