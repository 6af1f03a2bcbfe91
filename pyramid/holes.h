// What a hole is, what may fill one, and what may not.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/image.h"
#include "pomona/pixel_state.h"

namespace pomona {

/// A pixel whose disparity others may be filled from.
inline bool isSource(float disparity, std::uint8_t state) {
  return isMeasured(static_cast<PixelState>(state)) && !std::isnan(disparity);
}

/// A pixel to be filled: missing but not masked, or measured but NaN.
inline bool isHole(float disparity, std::uint8_t state) {
  const PixelState s = static_cast<PixelState>(state);  // without branches: who is a hole is hard to predict
  return (isMeasured(s) & std::isnan(disparity)) | (isMissing(s) & (s != PixelState::kMasked));
}

/// How much farther than a surface something must be to count as hidden by it.
constexpr float kVisibilityTolerance_px = 1.5f;

/// True if a surface of disparity `e` at the left view's (x, y) cannot be there: at x - e, rounded, the right
/// view sees something farther away than it, which it would hide.
inline bool wouldHideFromRight(ImageView<const float> right_disparity, int y, int x, float e) {
  const float x_right = std::floor(static_cast<float>(x) - e + 0.5f);
  if (!(x_right >= 0 && x_right < static_cast<float>(right_disparity.width))) return false;
  return right_disparity.at(y, static_cast<int>(x_right)) < e - kVisibilityTolerance_px;
}

}  // namespace pomona
