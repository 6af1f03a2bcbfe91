#include <cmath>

#include "evaluation/known_pixels.h"
#include "pomona/evaluation.h"

namespace pomona {

double SigmaCalibration::withinPercent(int sigmas) const {
  return 100 * ratio(static_cast<double>(within.at(static_cast<std::size_t>(sigmas - 1))), count);
}

SigmaCalibration sigmaCalibration(const cv::Mat& disparity, const cv::Mat& sigma, const cv::Mat& truth,
                                  const cv::Mat& mask) {
  requireComparable(disparity, truth, mask);
  requireLike("sigma", sigma, disparity.size(), CV_32F);

  SigmaCalibration calibration;
  forEachKnown(truth, mask, [&](int y, int x, float t) {
    const float d = disparity.at<float>(y, x);
    const double s = sigma.at<float>(y, x);
    if (!std::isfinite(d) || !std::isfinite(s) || s < 0) return;
    ++calibration.count;
    const double error_px = std::abs(d - t);
    for (std::size_t i = 0; i < calibration.within.size(); ++i)
      calibration.within[i] += error_px <= static_cast<double>(i + 1) * s;
  });
  return calibration;
}

}  // namespace pomona
