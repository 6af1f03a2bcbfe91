#include "filters/left_right.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "filters/flags.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr auto kMeasured = static_cast<std::uint8_t>(PixelState::kMeasured);

/// The right column nearest to x - d, or -1 if it lies outside the image or d is NaN.
inline int matchColumn(int x, float d, int width) {
  const float column = static_cast<float>(x) - d + 0.5f;  // truncated below, where it is not negative
  const bool inside = (column >= 0.0f) & (column < static_cast<float>(width));
  return static_cast<int>(inside ? column : -1.0f);
}

/// True if some right pixel in [begin, end) matches, by its own disparity, within `tolerance` of column `x`.
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

/// Flags the measured pixels x_begin + i, i < count, that fail the check.
void flagFailures(const float* d, const std::uint8_t* state, const float* right, int x_begin, int count,
                  int width, float threshold_px, FlagChunk& failed) {
  float back_disparity[FlagChunk::kPixels];
  int x_right[FlagChunk::kPixels];
  for (int i = 0; i < count; ++i) x_right[i] = matchColumn(x_begin + i, d[i], width);
  for (int i = 0; i < count; ++i) back_disparity[i] = right[std::max(0, x_right[i])];
  for (int i = 0; i < count; ++i) {
    const bool takes_part = (state[i] == kMeasured) & (d[i] == d[i]);
    const bool passes = (x_right[i] >= 0) & (std::fabs(d[i] - back_disparity[i]) <= threshold_px);
    failed.flags[i] = takes_part & !passes;
  }
}

}  // namespace

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, int threads) {
  const int width = disparity.width;
  const float tolerance = std::max(threshold_px, 1.0f);
  const auto reason = [&](const float* right, int x, float d) {
    if (matchColumn(x, d, width) < 0) return PixelState::kOutOfRange;
    const int begin = std::max(0, x - (min_disparity + num_disparities - 1));
    const int end = std::min(width, x - min_disparity + 1);
    return epipolarLineMeets(right, begin, end, x, tolerance) ? PixelState::kMismatched
                                                              : PixelState::kOccluded;
  };
  const auto check_row = [&](float* d, std::uint8_t* s, const float* right) {
    FlagChunk failed;
    for (int begin = 0; begin < width; begin += FlagChunk::kPixels) {
      const int count = std::min(FlagChunk::kPixels, width - begin);
      flagFailures(d + begin, s + begin, right, begin, count, width, threshold_px, failed);
      failed.forEachSet(count, [&](int i) {
        const int x = begin + i;
        s[x] = static_cast<std::uint8_t>(reason(right, x, d[x]));
        d[x] = std::numeric_limits<float>::quiet_NaN();
      });
    }
  };
  parallelStrips(threads, disparity.height, 8, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) check_row(disparity.row(y), state.row(y), right_disparity.row(y));
  });
}

}  // namespace pomona
