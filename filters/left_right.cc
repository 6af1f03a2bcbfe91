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

/// Marks each left column whose epipolar line meets the right map. `met` has `width` elements and one more.
void markMetColumns(const float* right, int width, const Search& search, const FilterKernels& kernels,
                    std::uint8_t* met) {
  std::int32_t first[kMatchChunk], last[kMatchChunk];
  std::fill_n(met, width + 1, std::uint8_t{0});
  for (int begin = 0; begin < width; begin += kMatchChunk) {
    const int count = std::min(kMatchChunk, width - begin);
    kernels.metColumns(
        {right + begin, begin, count, width, search.min_disparity, search.max_disparity, search.tolerance_px},
        first, last);
    for (int i = 0; i < count; ++i) {
      const int a = first[i], b = last[i];
      met[a] = met[(a + b) / 2] = met[b] = 1;
      if (b - a > 2) std::fill(met + a, met + b, std::uint8_t{1});  // a wide tolerance
    }
  }
}

void checkRow(float* d, std::uint8_t* state, const float* right, int width, const Search& search,
              const std::uint8_t* met, const FilterKernels& kernels) {
  static_assert(FlagChunk::kPixels == kMatchChunk);
  FlagChunk found;
  for (int begin = 0; begin < width; begin += kMatchChunk) {
    const int count = std::min(kMatchChunk, width - begin);
    kernels.contradictions({d + begin, right, begin, count, width}, search.threshold_px, found.flags);
    found.forEachSet(count, [&](int i) {
      const int x = begin + i;
      if (state[x] != kMeasured) return;
      state[x] = static_cast<std::uint8_t>(found.flags[i] == kMatchOutside ? PixelState::kOutOfRange
                                           : met[x] != 0                   ? PixelState::kMismatched
                                                                           : PixelState::kOccluded);
      d[x] = std::numeric_limits<float>::quiet_NaN();
    });
  }
}

}  // namespace

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, Arena& scratch, const FilterKernels& kernels, int threads) {
  const int width = disparity.width;
  const Search search{threshold_px, std::max(threshold_px, 1.0f), min_disparity,
                      min_disparity + num_disparities - 1};
  const Arena::Scope scope(scratch);
  const auto met_columns = scratch.image<std::uint8_t>(width + 1, disparity.height);
  parallelStrips(threads, disparity.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint8_t* met = met_columns.row(y);
      markMetColumns(right_disparity.row(y), width, search, kernels, met);
      checkRow(disparity.row(y), state.row(y), right_disparity.row(y), width, search, met, kernels);
    }
  });
}

}  // namespace pomona
