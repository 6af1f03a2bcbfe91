// Which pixels are holes.
#pragma once

#include <cstdint>

#include "pomona/pixel_state.h"
#include "pyramid/kernels.h"

namespace pomona {

inline constexpr HoleStates kHoleStates = {
    .measured = static_cast<std::uint8_t>(PixelState::kMeasured),
    .plane = static_cast<std::uint8_t>(PixelState::kFilledPlane),
    .missing = static_cast<std::uint8_t>(PixelState::kOccluded),
    .masked = static_cast<std::uint8_t>(PixelState::kMasked),
};

}  // namespace pomona
