// A texture of known shapes, and views of it, for tests of features.
#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pomona {

/// Blurred ellipses and boxes of all sizes and grays, the same for the same seed.
inline cv::Mat texture(int width, int height, std::uint64_t seed = 1) {
  cv::RNG random(seed);
  cv::Mat image(height, width, CV_8U, cv::Scalar(128));
  for (int i = 0; i < width * height / 800; ++i) {
    const cv::RotatedRect box(cv::Point2f(random.uniform(0.f, static_cast<float>(width)),
                                          random.uniform(0.f, static_cast<float>(height))),
                              cv::Size2f(random.uniform(5.f, 45.f), random.uniform(5.f, 45.f)),
                              random.uniform(0.f, 180.f));
    const cv::Scalar gray(random.uniform(20, 236));
    if (i % 2 == 0) {
      cv::ellipse(image, box, gray, cv::FILLED, cv::LINE_AA);
    } else {
      cv::Point2f corners[4];
      box.points(corners);
      std::vector<cv::Point> polygon(corners, corners + 4);
      cv::fillConvexPoly(image, polygon, gray, cv::LINE_AA);
    }
  }
  cv::GaussianBlur(image, image, {}, 1);
  return image;
}

/// Turned by `angle` (radians, from the x-axis towards the y-axis) and enlarged by `zoom`, about the centre.
inline cv::Matx33d turnAndZoom(cv::Size size, double angle, double zoom) {
  const double c = zoom * std::cos(angle), s = zoom * std::sin(angle);
  const double cx = (size.width - 1) / 2.0, cy = (size.height - 1) / 2.0;
  return {c, -s, cx - c * cx + s * cy, s, c, cy - s * cx - c * cy, 0, 0, 1};
}

inline cv::Mat warp(const cv::Mat& image, const cv::Matx33d& h) {
  cv::Mat result;
  cv::warpPerspective(image, result, h, image.size(), cv::INTER_CUBIC, cv::BORDER_CONSTANT, 128);
  return result;
}

}  // namespace pomona
