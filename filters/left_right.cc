#include "filters/left_right.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

/// True if a right pixel in [begin, end) and its own disparity lead to within `tolerance` of the left column
/// `x`.
bool epipolarLineMeets(const float* right, int begin, int end, int x, float tolerance) {
  constexpr int kChunk = 32;  // no branch inside: a chunk is tested by vector instructions
  for (; begin + kChunk <= end; begin += kChunk) {
    int hits = 0;
    for (int i = 0; i < kChunk; ++i)
      hits += std::fabs(right[begin + i] - static_cast<float>(x - begin - i)) <= tolerance;
    if (hits > 0) return true;
  }
  for (; begin < end; ++begin)
    if (std::fabs(right[begin] - static_cast<float>(x - begin)) <= tolerance) return true;
  return false;
}

}  // namespace

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, int threads) {
  const int width = disparity.width;
  const float tolerance = std::max(threshold_px, 1.0f);
  const auto reason = [&](const float* right, int x) {
    const int begin = std::max(0, x - (min_disparity + num_disparities - 1));
    const int end = std::min(width, x - min_disparity + 1);
    return epipolarLineMeets(right, begin, end, x, tolerance) ? PixelState::kMismatched
                                                              : PixelState::kOccluded;
  };
  parallelStrips(threads, disparity.height, 8, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      float* d = disparity.row(y);
      const float* right = right_disparity.row(y);
      std::uint8_t* s = state.row(y);
      for (int x = 0; x < width; ++x) {
        if (s[x] != static_cast<std::uint8_t>(PixelState::kMeasured) || std::isnan(d[x])) continue;
        const float x_right = static_cast<float>(x) - d[x] + 0.5f;  // truncated once known to be inside
        const bool inside = x_right >= 0.0f && x_right < static_cast<float>(width);
        if (inside && std::fabs(d[x] - right[static_cast<int>(x_right)]) <= threshold_px) continue;
        s[x] = static_cast<std::uint8_t>(inside ? reason(right, x) : PixelState::kOutOfRange);
        d[x] = std::numeric_limits<float>::quiet_NaN();
      }
    }
  });
}

}  // namespace pomona
