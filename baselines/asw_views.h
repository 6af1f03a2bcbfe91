// A view in the form that adaptive support weights work on.
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "core/image.h"

namespace pomona {

/// Planes of floats. Pixel (x, y) is at row(y)[x]; every row can be read from `margin` pixels before the view
/// to `margin` pixels after its width, rounded up to whole blocks of kAswBlock.
class FloatPlane {
 public:
  void resize(int width, int height, int margin, float outside);
  float* row(int y) { return image_.row(y) + margin_; }
  const float* row(int y) const { return image_.row(y) + margin_; }
  std::ptrdiff_t stride() const { return image_.view().stride; }

 private:
  Image<float> image_;
  int margin_ = 0;
};

struct AswView {
  int width, height;
  std::array<FloatPlane, 3> bgr;  ///< 8-bit units; 0 outside the view
  std::array<FloatPlane, 3> lab;  ///< CIELab (sRGB, D65); +infinity in the first outside the view

  /// `scale` brings the image's values to 8-bit units.
  AswView(const cv::Mat& image, double scale, int margin, int threads);
};

/// CIE 1976 L*a*b* of an sRGB colour given in 0 .. 255, for the white point D65.
std::array<float, 3> labFromBgr(const std::array<float, 3>& bgr);

}  // namespace pomona
