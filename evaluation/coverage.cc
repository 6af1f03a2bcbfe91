#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evaluation/known_pixels.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

struct Ranked {
  float confidence;
  bool wrong;
};

/// wrong[k] = expected number of wrong ones among the k most confident pixels. Within a group of equal
/// confidence any order is as good as another: the wrong ones are spread evenly.
std::vector<double> wrongAmongFirst(std::vector<Ranked>& pixels) {
  std::sort(pixels.begin(), pixels.end(),
            [](const Ranked& a, const Ranked& b) { return a.confidence > b.confidence; });
  std::vector<double> wrong(pixels.size() + 1, 0.0);
  for (std::size_t begin = 0, end; begin < pixels.size(); begin = end) {
    std::size_t wrong_in_group = 0;
    for (end = begin; end < pixels.size() && pixels[end].confidence == pixels[begin].confidence; ++end)
      wrong_in_group += pixels[end].wrong;
    const double share = static_cast<double>(wrong_in_group) / static_cast<double>(end - begin);
    for (std::size_t k = begin + 1; k <= end; ++k)
      wrong[k] = wrong[begin] + share * static_cast<double>(k - begin);
  }
  return wrong;
}

}  // namespace

CoverageCurve coverageCurve(const cv::Mat& disparity, const cv::Mat& confidence, const cv::Mat& truth,
                            const cv::Mat& mask, float threshold_px, int points) {
  requireComparable(disparity, truth, mask);
  requireLike("confidence", confidence, disparity.size(), CV_32F);
  if (points < 1) throw std::invalid_argument("points: " + std::to_string(points) + "; allowed: 1 or more");

  std::int64_t known = 0;
  std::size_t right = 0;
  std::vector<Ranked> pixels;
  forEachKnown(truth, mask, [&](int y, int x, float t) {
    ++known;
    const float d = disparity.at<float>(y, x), c = confidence.at<float>(y, x);
    if (!std::isfinite(d)) return;
    const bool wrong = std::abs(d - t) > threshold_px;
    right += !wrong;
    pixels.push_back({std::isnan(c) ? -std::numeric_limits<float>::infinity() : c, wrong});
  });

  CoverageCurve curve;
  const std::size_t n = pixels.size();
  const std::vector<double> wrong = wrongAmongFirst(pixels);
  const auto oracleWrong = [&](std::size_t k) { return static_cast<double>(k > right ? k - right : 0); };
  for (std::size_t k = 1; k <= n; ++k) {
    curve.area_percent += wrong[k] / static_cast<double>(k);
    curve.oracle_area_percent += oracleWrong(k) / static_cast<double>(k);
  }
  curve.area_percent = 100 * ratio(curve.area_percent, static_cast<std::int64_t>(n));
  curve.oracle_area_percent = 100 * ratio(curve.oracle_area_percent, static_cast<std::int64_t>(n));

  const std::size_t steps = std::min(static_cast<std::size_t>(points), n);
  for (std::size_t i = 1; i <= steps; ++i) {
    const std::size_t k = n * i / steps;
    const auto kept = static_cast<std::int64_t>(k);
    curve.points.push_back({100 * ratio(static_cast<double>(k), known), 100 * ratio(wrong[k], kept),
                            100 * ratio(oracleWrong(k), kept)});
  }
  return curve;
}

}  // namespace pomona
