#include "filters/left_right.h"

#include <algorithm>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {

void leftRightCheckRow(float* disparity, std::uint8_t* state, const float* right_disparity, int width,
                       const LeftRightLimits& limits, const FilterKernels& kernels) {
  kernels.leftRight({.width = width,
                     .min_disparity = limits.min_disparity,
                     .max_disparity = limits.min_disparity + limits.disparities - 1,
                     .threshold_px = limits.threshold_px,
                     .tolerance_px = std::max(limits.threshold_px, 1.0f),
                     .right = right_disparity,
                     .disparity = disparity,
                     .state = state,
                     .measured = static_cast<std::uint8_t>(PixelState::kMeasured),
                     .out_of_range = static_cast<std::uint8_t>(PixelState::kOutOfRange),
                     .mismatched = static_cast<std::uint8_t>(PixelState::kMismatched),
                     .occluded = static_cast<std::uint8_t>(PixelState::kOccluded)});
}

void leftRightCheck(ImageView<float> disparity, ImageView<std::uint8_t> state,
                    ImageView<const float> right_disparity, const LeftRightLimits& limits,
                    const FilterKernels& kernels, int threads) {
  parallelStrips(threads, disparity.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      leftRightCheckRow(disparity.row(y), state.row(y), right_disparity.row(y), disparity.width, limits,
                        kernels);
  });
}

}  // namespace pomona
