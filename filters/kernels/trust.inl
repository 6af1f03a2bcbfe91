// What the trust in a disparity rests on, packed (engine/trust.h). GCC vectorises the loop as it stands.
#pragma once

namespace pomona {
namespace {

inline void trustCodesOf(const TrustPixels& p, std::uint16_t* __restrict codes) {
  constexpr float kLast = kTrustSteps - 1;
  const float width = static_cast<float>(p.match.width);
  for (int i = 0; i < p.match.count; ++i) {
    const float d = p.match.disparity[i], at = static_cast<float>(p.match.x_begin + i) - d + 0.5f;
    const bool inside = (at >= 0.0f) & (at < width);
    const float difference = __builtin_fabsf(d - p.match.right[static_cast<int>(inside ? at : 0.0f)]);
    const float residual = 8 * difference, margin = p.scale * p.margin[i],
                curvature = p.scale * p.curvature[i];
    const int r = static_cast<int>(inside & (residual < kLast) ? residual : kLast);
    const int m = static_cast<int>(margin < kLast ? margin : kLast);
    const int c = static_cast<int>(curvature < kLast ? curvature : kLast);
    codes[i] = static_cast<std::uint16_t>((m * kTrustSteps + c) * kTrustSteps + r);
  }
}

}  // namespace
}  // namespace pomona
