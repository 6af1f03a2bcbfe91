#include "datasets/rendering/camera_effects.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "datasets/hash.h"
#include "datasets/rendering/require_range.h"

namespace pomona {
namespace {

using cv::Vec3d;

// exp(-x), x >= 0, by halving x until the series is short: libm's last bit differs between machines.
double expOfMinus(double x) {
  constexpr int kHalvings = 8;
  const double h = x / (1 << kHalvings);
  double e = 1 / (1 + h * (1 + h * (0.5 + h * (1.0 / 6 + h / 24))));
  for (int i = 0; i < kHalvings; ++i) e *= e;
  return e;
}

// Weights of the taps 0, 1, 2 ... of a Gaussian; the sum over both sides is 1.
std::vector<double> halfGaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(3.5 * sigma));
  std::vector<double> taps(radius + 1);
  double sum = 0;
  for (int i = 0; i <= radius; ++i) {
    taps[i] = expOfMinus(i * i / (2 * sigma * sigma));
    sum += (i == 0 ? 1 : 2) * taps[i];
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

// Rows, then columns. The image's edges are repeated.
void blur(cv::Mat& light, double sigma, int threads) {
  const std::vector<double> taps = halfGaussian(sigma);
  const int radius = static_cast<int>(taps.size()) - 1;
  cv::Mat across(light.size(), light.type());
  const auto blurTo = [&](cv::Mat& to, const auto& neighbour) {
    parallelStrips(threads, light.rows, 8, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < light.cols; ++x) {
          Vec3d sum = neighbour(y, x, 0) * taps[0];
          for (int i = 1; i <= radius; ++i) sum += (neighbour(y, x, -i) + neighbour(y, x, i)) * taps[i];
          to.at<Vec3d>(y, x) = sum;
        }
    });
  };
  blurTo(across,
         [&](int y, int x, int i) { return light.at<Vec3d>(y, std::clamp(x + i, 0, light.cols - 1)); });
  blurTo(light,
         [&](int y, int x, int i) { return across.at<Vec3d>(std::clamp(y + i, 0, light.rows - 1), x); });
}

// About normal, variance 1: the sum of 12 numbers in [0, 1).
double noiseAt(std::uint64_t seed) {
  double sum = -6;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t bits = hash(seed * 3 + static_cast<std::uint64_t>(i));
    for (int part = 0; part < 64; part += 16)
      sum += (static_cast<double>(bits >> part & 0xffff) + 0.5) / 65536;
  }
  return sum;
}

}  // namespace

void CameraEffects::validate() const {
  requireRange("blur_px", blur_px, 0, 10);
  requireRange("vignetting", vignetting, 0, 1);
  requireRange("exposure", exposure, 0.01, 100);
  requireRange("right_gain", right_gain, 0.1, 10);
  requireRange("shot_noise", shot_noise, 0, 100);
  requireRange("read_noise", read_noise, 0, 100);
}

cv::Mat develop(cv::Mat& light, const CameraEffects& effects, View view, int channels, int bits,
                int threads) {
  if (effects.blur_px > 0) blur(light, effects.blur_px, threads);
  const double cx = (light.cols - 1) / 2.0, cy = (light.rows - 1) / 2.0;
  const double corner2 = std::max(1.0, cx * cx + cy * cy);
  const double gain = view == View::kRight ? effects.right_gain : 1;
  const std::uint64_t seed = hash(effects.noise_seed * 2 + (view == View::kRight ? 1 : 0));
  const bool noisy = effects.shot_noise > 0 || effects.read_noise > 0;

  // A gray camera's pixel has noise of its own, so gray is mixed first.
  const auto valueAt = [&](int y, int x, int channel) {
    const Vec3d& bgr = light.at<Vec3d>(y, x);
    double value = channels == 1 ? 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2] : bgr[channel];
    const double r2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / corner2;
    value *= (1 - effects.vignetting * r2) * effects.exposure;
    if (noisy) {
      const double shot2 = effects.shot_noise * effects.shot_noise * std::max(0.0, value) / 255;
      const auto sample = (static_cast<std::uint64_t>(y) << 32) + static_cast<std::uint64_t>(x) * 4 +
                          static_cast<std::uint64_t>(channel);
      value += std::sqrt(shot2 + effects.read_noise * effects.read_noise) * noiseAt(seed + hash(sample));
    }
    return std::clamp(value * gain, 0.0, 255.0);
  };
  cv::Mat image(light.size(), CV_MAKETYPE(bits == 8 ? CV_8U : CV_16U, channels));
  parallelStrips(threads, image.rows, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < image.cols; ++x)
        for (int c = 0; c < channels; ++c) {
          const double value = valueAt(y, x, c);
          if (bits == 8)
            image.ptr<std::uint8_t>(y)[x * channels + c] = static_cast<std::uint8_t>(value + 0.5);
          else
            image.ptr<std::uint16_t>(y)[x * channels + c] = static_cast<std::uint16_t>(value * 257 + 0.5);
        }
  });
  return image;
}

}  // namespace pomona
