// Sines and cosines that are the same on every machine: libm's last bit is not.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// (cosine, sine) of an angle within +-360 degrees, to 1e-14.
inline cv::Vec2d cosineAndSine(double degrees) {
  constexpr int kHalvings = 6, kTerms = 9;
  const double x = degrees * (3.14159265358979323846 / 180) / (1 << kHalvings), x2 = x * x;
  double cosine = 1, sine = 1;  // of the small angle; the sine over x
  for (int n = kTerms; n >= 1; --n) {
    cosine = 1 - cosine * x2 / ((2 * n - 1) * (2 * n));
    sine = 1 - sine * x2 / (2 * n * (2 * n + 1));
  }
  sine *= x;
  for (int i = 0; i < kHalvings; ++i) {
    const double twice = 2 * sine * cosine;
    cosine = 1 - 2 * sine * sine;
    sine = twice;
  }
  return {cosine, sine};
}

}  // namespace pomona
