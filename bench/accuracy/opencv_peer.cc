#include "bench/accuracy/opencv_peer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

constexpr int kBlock = 3;
constexpr int kFixedPoint = cv::StereoMatcher::DISP_SCALE;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

cv::Mat grayWithMargin(const cv::Mat& image, int margin) {
  cv::Mat gray, extended;
  if (image.channels() == 1)
    gray = image;
  else
    cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  cv::copyMakeBorder(gray, extended, 0, 0, margin, 0, cv::BORDER_REPLICATE);
  return extended;
}

// False if the row has no disparity at all.
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

cv::Mat matchWithOpenCv(const cv::Mat& left, const cv::Mat& right, int num_disparities) {
  const auto matcher = cv::StereoSGBM::create(0, num_disparities, kBlock);
  matcher->setP1(8 * kBlock * kBlock);
  matcher->setP2(32 * kBlock * kBlock);
  matcher->setDisp12MaxDiff(1);
  matcher->setUniquenessRatio(10);
  matcher->setSpeckleWindowSize(100);
  matcher->setSpeckleRange(2);
  matcher->setPreFilterCap(63);
  matcher->setMode(cv::StereoSGBM::MODE_HH);

  cv::Mat fixed, disparity;
  matcher->compute(grayWithMargin(left, num_disparities), grayWithMargin(right, num_disparities), fixed);
  fixed = fixed.colRange(num_disparities, fixed.cols);
  fixed.convertTo(disparity, CV_32F, 1.0 / kFixedPoint);
  disparity.setTo(kUnknown, fixed < 0);
  return disparity;
}

void fillRowsFromBackground(cv::Mat& disparity) {
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
