// What a real camera does to light on its way to numbers.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace pomona {

/// In this order: blur, vignetting, exposure and gain, noise, rounding. Brightness counts in 8-bit units, 255
/// is white, proportional to light.
struct CameraEffects {
  double blur_px = 0;     ///< standard deviation of a Gaussian, 0..10
  double vignetting = 0;  ///< share of the light that the corners lose, 0..1; grows with the radius^2
  double exposure = 1;    ///< factor on both views' light, 0.01..100
  double right_gain = 1;  ///< factor on the right view's numbers, noise included, 0.1..10
  double shot_noise = 0;  ///< standard deviation at white, 0..100; falls with the root of the brightness
  double read_noise = 0;  ///< standard deviation at any brightness, 0..100
  std::uint64_t noise_seed = 0;

  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  void validate() const;
};

enum class View { kLeft, kRight };

/// The image (8 or 16 bits; 3 channels BGR, or 1 of gray) of `light`, CV_64FC3 in 8-bit units, which it uses
/// up. 16-bit values are 257 times as large. The same for any number of threads.
cv::Mat develop(cv::Mat& light, const CameraEffects& effects, View view, int channels, int bits, int threads);

}  // namespace pomona
