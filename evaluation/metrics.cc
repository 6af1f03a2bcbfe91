#include "evaluation/metrics.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace pomona {
namespace {

constexpr std::uint8_t kEvaluated = 255;

template <typename Part, typename Whole>
double ratio(Part part, Whole whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole)
                   : std::numeric_limits<double>::quiet_NaN();
}

void requireLike(const cv::Mat& image, const cv::Mat& disparity, int type, const char* what) {
  if (image.size() != disparity.size() || image.type() != type)
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(image.cols) + "x" +
                                std::to_string(image.rows) + " of " + cv::typeToString(image.type()) +
                                "; expected " + std::to_string(disparity.cols) + "x" +
                                std::to_string(disparity.rows) + " of " + cv::typeToString(type));
}

}  // namespace

double DisparityErrors::badPercent(std::size_t threshold) const {
  return 100 * ratio(wrong[threshold] + holes, known);
}
double DisparityErrors::wrongPercent(std::size_t threshold) const {
  return 100 * ratio(wrong[threshold], known - holes);
}
double DisparityErrors::coveragePercent() const {
  return 100 * ratio(known - holes, known);
}
double DisparityErrors::averageErrorPx() const {
  return ratio(error_sum_px, known - holes);
}

DisparityErrors compareWithTruth(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask) {
  requireLike(disparity, disparity, CV_32F, "disparity");
  requireLike(truth, disparity, CV_32F, "truth");
  if (!mask.empty()) requireLike(mask, disparity, CV_8U, "mask");

  DisparityErrors errors;
  for (int y = 0; y < disparity.rows; ++y) {
    const float* d = disparity.ptr<float>(y);
    const float* t = truth.ptr<float>(y);
    const std::uint8_t* m = mask.empty() ? nullptr : mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      if (!std::isfinite(t[x]) || (m && m[x] != kEvaluated)) continue;
      ++errors.known;
      if (!std::isfinite(d[x])) {
        ++errors.holes;
        continue;
      }
      const float error_px = std::abs(d[x] - t[x]);
      errors.error_sum_px += error_px;
      for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i)
        errors.wrong[i] += error_px > kBadThresholds_px[i];
    }
  }
  return errors;
}

}  // namespace pomona
