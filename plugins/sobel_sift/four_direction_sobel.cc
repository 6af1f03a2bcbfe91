#include "plugins/sobel_sift/four_direction_sobel.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace pomona {

cv::Mat sobelMask(int direction) {
  switch (direction) {
    case 0:
      return cv::Mat_<float>(3, 3) << -1, 0, 1, -2, 0, 2, -1, 0, 1;
    case 1:
      return cv::Mat_<float>(3, 3) << 0, 1, 2, -1, 0, 1, -2, -1, 0;
    case 2:
      return cv::Mat_<float>(3, 3) << 1, 2, 1, 0, 0, 0, -1, -2, -1;
    case 3:
      return cv::Mat_<float>(3, 3) << 2, 1, 0, 1, 0, -1, 0, -1, -2;
    default:
      throw std::invalid_argument("direction is " + std::to_string(direction) + "; allowed: 0 to 3");
  }
}

cv::Mat edgeStrength(const cv::Mat& gray) {
  cv::Mat strongest(gray.size(), CV_16S, cv::Scalar(0));
  for (int direction = 0; direction < 4; ++direction) {
    cv::Mat gradient;
    cv::filter2D(gray, gradient, CV_16S, sobelMask(direction), cv::Point(-1, -1), 0, cv::BORDER_REPLICATE);
    cv::max(strongest, cv::abs(gradient), strongest);
  }
  cv::Mat edges;
  strongest.convertTo(edges, CV_8U, 0.25);
  return edges;
}

cv::Mat fusedWithEdges(const cv::Mat& gray, double weight) {
  if (weight == 0) return gray;
  cv::Mat fused;
  cv::addWeighted(gray, 1 - weight, edgeStrength(gray), weight, 0, fused);
  return fused;
}

}  // namespace pomona
