#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evaluation/known_pixels.h"
#include "pomona/evaluation.h"

namespace pomona {

double SubpixelErrors::Bin::biasPx() const {
  return ratio(error_sum_px, count);
}
double SubpixelErrors::Bin::rmsPx() const {
  return std::sqrt(ratio(squared_error_sum_px2, count));
}

SubpixelErrors subpixelErrors(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask, int bins,
                              float inlier_px) {
  requireComparable(disparity, truth, mask);
  if (bins < 1) throw std::invalid_argument("bins: " + std::to_string(bins) + "; allowed: 1 or more");

  SubpixelErrors errors;
  errors.bins.resize(static_cast<std::size_t>(bins));
  forEachKnown(truth, mask, [&](int y, int x, float t) {
    const double error_px = disparity.at<float>(y, x) - t;
    if (!(std::abs(error_px) <= inlier_px)) return;  // a hole, too
    const double fraction = t - std::floor(t);
    const auto bin = std::min(errors.bins.size() - 1, static_cast<std::size_t>(fraction * bins));
    for (SubpixelErrors::Bin* b : {&errors.bins[bin], &errors.all}) {
      ++b->count;
      b->error_sum_px += error_px;
      b->squared_error_sum_px2 += error_px * error_px;
    }
  });
  return errors;
}

}  // namespace pomona
