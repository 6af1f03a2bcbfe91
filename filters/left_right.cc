#include "filters/left_right.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "filters/flags.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr auto kMeasured = static_cast<std::uint8_t>(PixelState::kMeasured);

struct Search {
  float threshold_px, tolerance_px;
  int min_disparity, max_disparity;
};

/// Whether the epipolar line of left column x meets the right map.
bool isMet(const float* right, int width, int x, const Search& search, const FilterKernels& kernels) {
  const int first = std::max(0, x - search.max_disparity),
            last = std::min(width - 1, x - search.min_disparity);
  return first <= last && kernels.meetsAny(right + first, last - first + 1, x - first, search.tolerance_px);
}

void checkRow(float* d, std::uint8_t* state, const float* right, int width, const Search& search,
              const FilterKernels& kernels) {
  static_assert(FlagChunk::kPixels == kMatchChunk);
  FlagChunk found;
  for (int begin = 0; begin < width; begin += kMatchChunk) {
    const int count = std::min(kMatchChunk, width - begin);
    kernels.contradictions({d + begin, right, begin, count, width}, search.threshold_px, found.flags);
    found.forEachSet(count, [&](int i) {
      const int x = begin + i;
      if (state[x] != kMeasured) return;
      state[x] = static_cast<std::uint8_t>(found.flags[i] == kMatchOutside           ? PixelState::kOutOfRange
                                           : isMet(right, width, x, search, kernels) ? PixelState::kMismatched
                                                                                     : PixelState::kOccluded);
      d[x] = std::numeric_limits<float>::quiet_NaN();
    });
  }
}

}  // namespace

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, const FilterKernels& kernels, int threads) {
  const Search search{threshold_px, std::max(threshold_px, 1.0f), min_disparity,
                      min_disparity + num_disparities - 1};
  parallelStrips(threads, disparity.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      checkRow(disparity.row(y), state.row(y), right_disparity.row(y), disparity.width, search, kernels);
  });
}

}  // namespace pomona
