#include "apps/views.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace pomona {

cv::Mat toBgr8(const cv::Mat& image) {
  cv::Mat bytes, bgr;
  image.convertTo(bytes, CV_8U, image.depth() == CV_16U ? 1 / 257.0 : 1);
  if (bytes.channels() == 3) return bytes;
  cv::cvtColor(bytes, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

void toBytes(cv::Mat& left, cv::Mat& right) {
  if (left.depth() == CV_8U) return;
  double largest = 0;
  for (const cv::Mat& view : {left, right}) {
    double in_view = 0;
    cv::minMaxIdx(view.reshape(1), nullptr, &in_view);
    largest = std::max(largest, in_view);
  }
  double scale = 1;
  while (largest * scale >= 256) scale /= 2;
  for (cv::Mat* view : {&left, &right}) view->convertTo(*view, CV_8U, scale);
}

}  // namespace pomona
