#include "filters/left_right.h"

#include <algorithm>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, float threshold_px, int min_disparity,
                    int num_disparities, LeftRightScratch& scratch, const FilterKernels& kernels,
                    int threads) {
  const int width = disparity.width;
  scratch.marks.resize(kMarksPerPixel * (width + 2), disparity.height);
  parallelStrips(threads, disparity.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      kernels.leftRight({.width = width,
                         .min_disparity = min_disparity,
                         .max_disparity = min_disparity + num_disparities - 1,
                         .threshold_px = threshold_px,
                         .tolerance_px = std::max(threshold_px, 1.0f),
                         .right = right_disparity.row(y),
                         .disparity = disparity.row(y),
                         .state = state.row(y),
                         .measured = static_cast<std::uint8_t>(PixelState::kMeasured),
                         .out_of_range = static_cast<std::uint8_t>(PixelState::kOutOfRange),
                         .mismatched = static_cast<std::uint8_t>(PixelState::kMismatched),
                         .occluded = static_cast<std::uint8_t>(PixelState::kOccluded),
                         .marks = scratch.marks.row(begin)});
  });
}

}  // namespace pomona
