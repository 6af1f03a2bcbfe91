#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/known_pixels.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

constexpr double kOutlier_px = 3;
constexpr double kOutlierShareOfTruth = 1.0 / 20;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// False if the row has no disparity at all.
bool fillRow(float* d, int width) {
  for (int x = 0; x < width;) {
    if (!std::isnan(d[x])) {
      ++x;
      continue;
    }
    const int end =
        static_cast<int>(std::find_if(d + x, d + width, [](float v) { return !std::isnan(v); }) - d);
    if (x == 0 && end == width) return false;
    // fmin ignores the NaN of a side that has no disparity.
    const float fill = std::fmin(x > 0 ? d[x - 1] : kUnknown, end < width ? d[end] : kUnknown);
    std::fill(d + x, d + end, fill);
    x = end;
  }
  return true;
}

}  // namespace

double KittiErrors::Region::d1Percent() const {
  return 100 * ratio(static_cast<double>(outliers + holes), known);
}
double KittiErrors::Region::outlierPercent() const {
  return 100 * ratio(static_cast<double>(outliers), known - holes);
}
KittiErrors::Region KittiErrors::all() const {
  return {background.known + foreground.known, background.holes + foreground.holes,
          background.outliers + foreground.outliers};
}

KittiErrors kittiErrors(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& object_map,
                        const cv::Mat& mask) {
  requireComparable(disparity, truth, mask);
  if (!object_map.empty()) requireLike("object map", object_map, truth.size(), CV_8U);

  KittiErrors errors;
  forEachKnown(truth, mask, [&](int y, int x, float t) {
    const bool is_object = !object_map.empty() && object_map.at<std::uint8_t>(y, x) != 0;
    KittiErrors::Region& region = is_object ? errors.foreground : errors.background;
    ++region.known;
    const float d = disparity.at<float>(y, x);
    const double error_px = std::abs(d - t);
    if (!std::isfinite(d))
      ++region.holes;
    else if (error_px > kOutlier_px && error_px > kOutlierShareOfTruth * std::abs(t))
      ++region.outliers;
  });
  return errors;
}

void fillRowsFromBackground(cv::Mat& disparity) {
  requireLike("disparity", disparity, disparity.size(), CV_32F);
  int first = -1;  // the first row with a disparity
  for (int y = 0; y < disparity.rows; ++y) {
    if (fillRow(disparity.ptr<float>(y), disparity.cols)) {
      if (first < 0) first = y;
    } else if (first >= 0) {
      disparity.row(y - 1).copyTo(disparity.row(y));
    }
  }
  for (int y = first - 1; y >= 0; --y) disparity.row(first).copyTo(disparity.row(y));
}

}  // namespace pomona
