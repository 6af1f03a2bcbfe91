#include "filters/left_right.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "filters/flags.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr auto kMeasured = static_cast<std::uint8_t>(PixelState::kMeasured);

/// Marks each left column x that the epipolar lines of a row meet the right map for: x = q + e with a whole
/// disparity e, min_disparity <= e <= max_disparity, within `tolerance_px` of right[q].
void markMetColumns(const float* right, int width, int min_disparity, int max_disparity, float tolerance_px,
                    const FilterKernels& kernels, std::uint8_t* met) {
  std::int32_t first[FlagChunk::kPixels], last[FlagChunk::kPixels];
  std::fill_n(met, width, std::uint8_t{0});
  for (int begin = 0; begin < width; begin += FlagChunk::kPixels) {
    const int count = std::min(FlagChunk::kPixels, width - begin);
    kernels.metDisparities(right + begin, count, tolerance_px, first, last);
    for (int i = 0; i < count; ++i) {
      const int q = begin + i, end = std::min({last[i], max_disparity, width - 1 - q});
      for (int e = std::max({first[i], min_disparity, -q}); e <= end; ++e) met[q + e] = 1;
    }
  }
}

/// Checks one row. `met`: see markMetColumns.
void checkRow(float* d, std::uint8_t* state, const float* right, int width, float threshold_px,
              const std::uint8_t* met, const FilterKernels& kernels) {
  std::int32_t column[FlagChunk::kPixels];
  float difference[FlagChunk::kPixels];
  FlagChunk failed;
  for (int begin = 0; begin < width; begin += FlagChunk::kPixels) {
    const int count = std::min(FlagChunk::kPixels, width - begin);
    kernels.matches({d + begin, right, begin, count, width}, column, difference);
    for (int i = 0; i < count; ++i) {
      const bool takes_part = (state[begin + i] == kMeasured) & (d[begin + i] == d[begin + i]);
      failed.flags[i] = takes_part & !((column[i] >= 0) & (difference[i] <= threshold_px));
    }
    failed.forEachSet(count, [&](int i) {
      const int x = begin + i;
      state[x] = static_cast<std::uint8_t>(column[i] < 0 ? PixelState::kOutOfRange
                                           : met[x] != 0 ? PixelState::kMismatched
                                                         : PixelState::kOccluded);
      d[x] = std::numeric_limits<float>::quiet_NaN();
    });
  }
}

}  // namespace

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, LeftRightScratch& scratch, const FilterKernels& kernels,
                    int threads) {
  const int width = disparity.width;
  const float tolerance_px = std::max(threshold_px, 1.0f);
  scratch.met.resize(width, disparity.height);
  parallelStrips(threads, disparity.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* right = right_disparity.row(y);
      std::uint8_t* met = scratch.met.row(y);
      markMetColumns(right, width, min_disparity, min_disparity + num_disparities - 1, tolerance_px, kernels,
                     met);
      checkRow(disparity.row(y), state.row(y), right, width, threshold_px, met, kernels);
    }
  });
}

}  // namespace pomona
