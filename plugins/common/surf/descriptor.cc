#include "plugins/common/surf/descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/common/surf/haar.h"

namespace pomona {
namespace {

constexpr int kCells = 4, kSamplesPerCell = 5, kSamples = kCells * kSamplesPerCell;
constexpr float kSigma = 3.3f;  // in units of the scale

constexpr float fromCentre(int sample) {
  return static_cast<float>(sample) - (kSamples - 1) / 2.0f;
}

/// The Gaussian along one axis.
const std::array<float, kSamples>& weights() {
  static const std::array<float, kSamples> table = [] {
    std::array<float, kSamples> values{};
    for (int i = 0; i < kSamples; ++i)
      values[i] = std::exp(-fromCentre(i) * fromCentre(i) / (2 * kSigma * kSigma));
    return values;
  }();
  return table;
}

void add(float dx, float dy, bool extended, float* cell) {
  if (extended) {
    float* of_dx = cell + (dy < 0 ? 0 : 2);
    float* of_dy = cell + (dx < 0 ? 4 : 6);
    of_dx[0] += dx;
    of_dx[1] += std::abs(dx);
    of_dy[0] += dy;
    of_dy[1] += std::abs(dy);
  } else {
    cell[0] += dx;
    cell[1] += std::abs(dx);
    cell[2] += dy;
    cell[3] += std::abs(dy);
  }
}

void normalize(float* values, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += static_cast<double>(values[i]) * values[i];
  if (sum == 0) return;
  const double factor = 1 / std::sqrt(sum);
  for (int i = 0; i < count; ++i) values[i] = static_cast<float>(values[i] * factor);
}

}  // namespace

void describe(const IntegralImage& image, const DescriptorFrame& frame, bool extended, float* out) {
  const int length = descriptorLength(extended), per_cell = length / (kCells * kCells);
  std::fill_n(out, length, 0.0f);
  const float c = std::cos(frame.angle), s = std::sin(frame.angle);
  const int half = toFixed(frame.scale);
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      const float u = fromCentre(i) * frame.scale, v = fromCentre(j) * frame.scale;
      // As in the paper, the wavelets are upright, and their responses are turned instead.
      const auto [dx, dy] =
          haarResponse(image, toFixed(frame.x + c * u - s * v), toFixed(frame.y + s * u + c * v), half);
      const float weight = weights()[i] * weights()[j];
      const int cell = j / kSamplesPerCell * kCells + i / kSamplesPerCell;
      add(weight * (c * dx + s * dy), weight * (c * dy - s * dx), extended, out + cell * per_cell);
    }
  normalize(out, length);
}

}  // namespace pomona
