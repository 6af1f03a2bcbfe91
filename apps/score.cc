#include "apps/score.h"

#include <algorithm>
#include <cmath>

namespace pomona {

Score scoreAgainst(const cv::Mat& disparity, const cv::Mat& ground_truth) {
  std::size_t known = 0, found = 0, bad1 = 0, bad2 = 0;
  double error_sum = 0;
  for (int y = 0; y < disparity.rows; ++y)
    for (int x = 0; x < disparity.cols; ++x) {
      const float truth = ground_truth.at<float>(y, x);
      if (std::isnan(truth)) continue;
      ++known;
      const double error = std::abs(double{disparity.at<float>(y, x)} - truth);
      bad1 += !(error <= 1);  // holds for NaN, a hole, as well
      bad2 += !(error <= 2);
      if (std::isnan(error)) continue;
      ++found;
      error_sum += error;
    }
  const auto percent = [&](std::size_t count) { return 100.0 * count / std::max<std::size_t>(1, known); };
  return {known, percent(bad1), percent(bad2), error_sum / std::max<std::size_t>(1, found), percent(found)};
}

}  // namespace pomona
