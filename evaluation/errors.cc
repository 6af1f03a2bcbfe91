#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evaluation/known_pixels.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

std::string sizeText(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

int ratioOfSizes(cv::Size truth, cv::Size map) {
  for (const int ratio : {1, 2, 4})
    if (truth == map * ratio) return ratio;
  throw std::invalid_argument("truth: " + sizeText(truth) +
                              "; allowed: 1, 2 or 4 times the disparity map's " + sizeText(map));
}

/// The disparity as the rules want it compared, in pixels of the truth; NaN for a hole.
float judged(float d, int ratio, const EvaluationRules& rules) {
  if (!std::isfinite(d) || std::abs(d) > rules.hole_beyond_px) return DisparityErrors::kUnknown;
  const float scale = static_cast<float>(ratio);
  d *= scale;
  if (rules.clip_to_px != EvaluationRules::kNoLimit) d = std::clamp(d, 0.0f, scale * rules.clip_to_px);
  return rules.round ? std::round(d) : d;
}

void noteQuantiles(std::vector<float>& errors_px, DisparityErrors& out) {
  if (errors_px.empty()) return;
  auto from = errors_px.begin();
  for (std::size_t i = 0; i < kErrorQuantiles_percent.size(); ++i) {
    const auto at =
        errors_px.begin() + static_cast<std::ptrdiff_t>(errors_px.size() * kErrorQuantiles_percent[i] / 100);
    std::nth_element(from, at, errors_px.end());
    out.quantile_px[i] = *at;
    from = at;
  }
}

}  // namespace

void requireLike(const char* what, const cv::Mat& map, cv::Size size, int type) {
  if (map.size() != size || map.type() != type)
    throw std::invalid_argument(std::string(what) + ": " + sizeText(map.size()) + " of " +
                                cv::typeToString(map.type()) + "; expected " + sizeText(size) + " of " +
                                cv::typeToString(type));
}

void requireComparable(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask) {
  requireLike("disparity", disparity, disparity.size(), CV_32F);
  requireLike("truth", truth, disparity.size(), CV_32F);
  if (!mask.empty()) requireLike("mask", mask, truth.size(), CV_8U);
}

double DisparityErrors::badPercent(std::size_t threshold) const {
  return 100 * ratio(static_cast<double>(wrong[threshold] + holes), known);
}
double DisparityErrors::wrongOfKnownPercent(std::size_t threshold) const {
  return 100 * ratio(static_cast<double>(wrong[threshold]), known);
}
double DisparityErrors::wrongPercent(std::size_t threshold) const {
  return 100 * ratio(static_cast<double>(wrong[threshold]), found());
}
double DisparityErrors::invalidPercent() const {
  return 100 * ratio(static_cast<double>(holes), known);
}
double DisparityErrors::coveragePercent() const {
  return 100 * ratio(static_cast<double>(found()), known);
}
double DisparityErrors::averageErrorPx() const {
  return ratio(error_sum_px, found());
}
double DisparityErrors::rmsErrorPx() const {
  return std::sqrt(ratio(squared_error_sum_px2, found()));
}

DisparityErrors compareWithTruth(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask,
                                 const EvaluationRules& rules) {
  requireLike("disparity", disparity, disparity.size(), CV_32F);
  requireLike("truth", truth, truth.size(), CV_32F);
  if (!mask.empty()) requireLike("mask", mask, truth.size(), CV_8U);
  const int size_ratio = ratioOfSizes(truth.size(), disparity.size());

  DisparityErrors errors;
  std::vector<float> errors_px;
  errors_px.reserve(truth.total());
  forEachKnown(truth, mask, [&](int y, int x, float t) {
    ++errors.known;
    const float d = judged(disparity.at<float>(y / size_ratio, x / size_ratio), size_ratio, rules);
    if (std::isnan(d)) {
      ++errors.holes;
      return;
    }
    const float error_px = std::abs(d - t);
    errors_px.push_back(error_px);
    errors.error_sum_px += error_px;
    errors.squared_error_sum_px2 += static_cast<double>(error_px) * error_px;
    for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i)
      errors.wrong[i] += error_px > kBadThresholds_px[i];
  });
  noteQuantiles(errors_px, errors);
  return errors;
}

}  // namespace pomona
