#include "apps/views.h"

#include <opencv2/imgproc.hpp>

namespace pomona {

cv::Mat toBgr8(const cv::Mat& image) {
  cv::Mat bytes, bgr;
  image.convertTo(bytes, CV_8U, image.depth() == CV_16U ? 1 / 257.0 : 1);
  if (bytes.channels() == 3) return bytes;
  cv::cvtColor(bytes, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

}  // namespace pomona
