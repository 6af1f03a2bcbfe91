#include "plugins/common/surf/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plugins/common/surf/haar.h"

namespace pomona {
namespace {

constexpr int kRadius = 6;   // in units of the scale
constexpr float kSigma = 2;  // in units of the scale
constexpr int kMostSamples = (2 * kRadius + 1) * (2 * kRadius + 1);
constexpr float kWindow = std::numbers::pi_v<float> / 3;
constexpr float kTurn = 2 * std::numbers::pi_v<float>;

struct Sample {
  float angle, dx, dy;
};

/// The samples that are not flat, by angle. Returns how many.
int sampleAround(const IntegralImage& image, float x, float y, float scale,
                 std::array<Sample, kMostSamples>& samples) {
  int count = 0;
  const int half = toFixed(2 * scale);
  for (int v = -kRadius; v <= kRadius; ++v)
    for (int u = -kRadius; u <= kRadius; ++u) {
      const int distance2 = u * u + v * v;
      if (distance2 >= kRadius * kRadius) continue;
      const auto [dx, dy] = haarResponse(image, toFixed(x + static_cast<float>(u) * scale),
                                         toFixed(y + static_cast<float>(v) * scale), half);
      if (dx == 0 && dy == 0) continue;
      const float weight = std::exp(static_cast<float>(-distance2) / (2 * kSigma * kSigma));
      samples[count++] = {std::atan2(dy, dx), weight * dx, weight * dy};
    }
  std::stable_sort(samples.begin(), samples.begin() + count,
                   [](const Sample& a, const Sample& b) { return a.angle < b.angle; });
  return count;
}

}  // namespace

float dominantOrientation(const IntegralImage& image, float x, float y, float scale) {
  std::array<Sample, kMostSamples> samples;
  const int count = sampleAround(image, x, y, scale, samples);
  // The window [first, last) starts at each sample in turn; `last` runs on past the end, around the circle.
  double sum_x = 0, sum_y = 0, longest = -1, best_x = 1, best_y = 0;
  int last = 0;
  for (int first = 0; first < count; ++first) {
    while (last < first + count) {
      const Sample& next = samples[last % count];
      const float angle = next.angle + (last < count ? 0 : kTurn);
      if (angle > samples[first].angle + kWindow) break;
      sum_x += next.dx;
      sum_y += next.dy;
      ++last;
    }
    const double length = sum_x * sum_x + sum_y * sum_y;
    if (length > longest) longest = length, best_x = sum_x, best_y = sum_y;
    sum_x -= samples[first].dx;
    sum_y -= samples[first].dy;
  }
  return static_cast<float>(std::atan2(best_y, best_x));
}

}  // namespace pomona
