#include "plugins/common/surf/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "plugins/common/surf/haar.h"

namespace pomona {
namespace {

constexpr int kRadius = 6;     // in units of the scale
constexpr float kSigma = 2;    // in units of the scale
constexpr float kWindow = 60;  // degrees

/// The places of the wavelets, in units of the scale, and their weights.
struct Spot {
  float u, v, weight;
};
const std::vector<Spot>& spots() {
  static const std::vector<Spot> table = [] {
    std::vector<Spot> inside;
    for (int v = -kRadius; v <= kRadius; ++v)
      for (int u = -kRadius; u <= kRadius; ++u)
        if (const int distance2 = u * u + v * v; distance2 < kRadius * kRadius)
          inside.push_back({static_cast<float>(u), static_cast<float>(v),
                            std::exp(static_cast<float>(-distance2) / (2 * kSigma * kSigma))});
    return inside;
  }();
  return table;
}

struct Sample {
  float angle;  // degrees, in [0, 360]; good to 0.3, and only for the order and the window
  int spot;
  float dx, dy;
};

/// The responses that are not 0, by angle, in `samples`, which has room for all spots. Returns how many.
int sampleAround(const IntegralImage& image, float x, float y, float scale, Sample* samples) {
  int count = 0;
  const int half = toFixed(2 * scale), all = static_cast<int>(spots().size());
  for (int i = 0; i < all; ++i) {
    const Spot& spot = spots()[i];
    const auto [dx, dy] = haarResponse(image, toFixed(x + spot.u * scale), toFixed(y + spot.v * scale), half);
    if (dx != 0 || dy != 0) samples[count++] = {cv::fastAtan2(dy, dx), i, spot.weight * dx, spot.weight * dy};
  }
  std::sort(samples, samples + count, [](const Sample& a, const Sample& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.spot < b.spot;
  });
  return count;
}

}  // namespace

float dominantOrientation(const IntegralImage& image, float x, float y, float scale) {
  std::array<Sample, (2 * kRadius + 1) * (2 * kRadius + 1)> samples;
  const int count = sampleAround(image, x, y, scale, samples.data());
  // The window [first, last) starts at each sample in turn; `last` runs on past the end, around the circle.
  double sum_x = 0, sum_y = 0, longest = -1, best_x = 1, best_y = 0;
  int last = 0;
  for (int first = 0; first < count; ++first) {
    while (last < first + count) {
      const Sample& next = samples[last % count];
      const float angle = next.angle + (last < count ? 0 : 360);
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
