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

/// Along one axis: how much each sample counts in each cell. That is the Gaussian, times a share that falls
/// linearly from the middle of the cell to that of the next one.
using Shares = std::array<std::array<float, kCells>, kSamples>;
const Shares& shares() {
  static const Shares table = [] {
    Shares values{};
    for (int i = 0; i < kSamples; ++i)
      for (int cell = 0; cell < kCells; ++cell) {
        const float middle =
            fromCentre(0) + kSamplesPerCell * static_cast<float>(cell) + (kSamplesPerCell - 1) / 2.0f;
        const float share = std::max(0.0f, 1 - std::abs(fromCentre(i) - middle) / kSamplesPerCell);
        values[i][cell] = share * std::exp(-fromCentre(i) * fromCentre(i) / (2 * kSigma * kSigma));
      }
    return values;
  }();
  return table;
}

/// What one sample adds to a cell: 4 values, or, for the extended descriptor, 8.
template <int kValues>
std::array<float, kValues> contributions(float dx, float dy) {
  if constexpr (kValues == 4) {
    return {dx, std::abs(dx), dy, std::abs(dy)};
  } else {
    std::array<float, kValues> values{};
    float* of_dx = values.data() + (dy < 0 ? 0 : 2);
    float* of_dy = values.data() + (dx < 0 ? 4 : 6);
    of_dx[0] = dx;
    of_dx[1] = std::abs(dx);
    of_dy[0] = dy;
    of_dy[1] = std::abs(dy);
    return values;
  }
}

/// Cells by row, column and value; samples are handed out to columns of cells first, and row by row to rows
/// of cells.
template <int kValues>
void sumUp(const IntegralImage& image, const DescriptorFrame& frame, float* out) {
  const float c = std::cos(frame.angle), s = std::sin(frame.angle);
  const int half = toFixed(frame.scale);
  for (int j = 0; j < kSamples; ++j) {
    std::array<float, kCells * kValues> row{};
    for (int i = 0; i < kSamples; ++i) {
      const float u = fromCentre(i) * frame.scale, v = fromCentre(j) * frame.scale;
      // As in the paper, the wavelets are upright, and their responses are turned instead.
      const auto [dx, dy] =
          haarResponse(image, toFixed(frame.x + c * u - s * v), toFixed(frame.y + s * u + c * v), half);
      const auto values = contributions<kValues>(c * dx + s * dy, c * dy - s * dx);
      for (int cell = 0; cell < kCells; ++cell)
        for (int k = 0; k < kValues; ++k) row[cell * kValues + k] += shares()[i][cell] * values[k];
    }
    for (int cell = 0; cell < kCells; ++cell)
      for (int k = 0; k < kCells * kValues; ++k)
        out[cell * kCells * kValues + k] += shares()[j][cell] * row[k];
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
  std::fill_n(out, descriptorLength(extended), 0.0f);
  if (extended)
    sumUp<8>(image, frame, out);
  else
    sumUp<4>(image, frame, out);
  normalize(out, descriptorLength(extended));
}

}  // namespace pomona
