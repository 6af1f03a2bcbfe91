// What the trust in a disparity rests on, packed, and the trust itself (engine/trust.h). GCC vectorises the
// loops as they stand.
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

inline void trustPairsOf(const TrustPair* of_code, const std::uint16_t* codes, const std::uint8_t* state,
                         std::uint8_t measured, int count, float* __restrict confidence,
                         float* __restrict sigma_px) {
  std::int32_t index[kMatchChunk];
  for (int i = 0; i < count; ++i) index[i] = 2 * (state[i] == measured ? codes[i] : kTrustCodes + state[i]);
  gatherPairs(&of_code->confidence, index, count, confidence, sigma_px);
}

}  // namespace
}  // namespace pomona
