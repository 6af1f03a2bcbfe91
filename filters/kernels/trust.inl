// What the trust in a disparity rests on, packed (engine/trust.h). GCC vectorises the loop as it stands.
#pragma once

#include "filters/kernels/left_right.inl"

namespace pomona {
namespace {

inline void trustCodesOf(const TrustPixels& p, std::uint16_t* __restrict codes) {
  constexpr float kLast = kTrustSteps - 1;
  std::int32_t column[kMatchChunk];
  float difference[kMatchChunk];
  matchesOf(p.match, column, difference);
  const std::uint16_t *margins = p.margin, *curvatures = p.curvature;
  const float scale = p.scale;
  const int count = p.match.count;
  for (int i = 0; i < count; ++i) {
    const float residual = 8 * difference[i], margin = scale * margins[i], curvature = scale * curvatures[i];
    const int r = static_cast<int>((column[i] >= 0) & (residual < kLast) ? residual : kLast);
    const int m = static_cast<int>(margin < kLast - 1 ? margin : kLast - 1) + (margin >= 0.5f);
    const int c = static_cast<int>(curvature < kLast ? curvature : kLast);
    codes[i] = static_cast<std::uint16_t>((m * kTrustSteps + c) * kTrustSteps + r);
  }
}

}  // namespace
}  // namespace pomona
