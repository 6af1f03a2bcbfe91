#include "engine/trust.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

/// A polynomial in the features of a measured pixel.
struct Fit {
  double constant, margin, margin_squared, curvature, residual, no_residual;

  double of(const TrustFeatures& f) const {
    const bool none = f.residual == TrustFeatures::kResiduals - 1;
    return constant + margin * f.margin + margin_squared * f.margin * f.margin + curvature * f.curvature +
           (none ? no_residual : residual * f.residual);
  }
};

// Printed by bench/confidence.
constexpr Fit kLogOdds = {3.384, 0.1741, 0.02215, -0.0983, -0.0968, -2.283};
constexpr Fit kLogSigma = {-1.101, -0.0960, 0.00293, 0.0129, 0.0299, 0.940};

constexpr Trust::Pair trustInFilled(PixelState state) {
  switch (state) {
    case PixelState::kFilledPlane:
      return {0.89f, 0.43f};
    case PixelState::kFilledBackground:
      return {0.58f, 6.38f};
    case PixelState::kFilledInterpolated:
      return {0.48f, 16.40f};
    case PixelState::kFilledCoarse:
      return {0.44f, 2.78f};
    default:
      return {0.0f, std::numeric_limits<float>::quiet_NaN()};
  }
}

}  // namespace

TrustFeatures trustFeatures(const MatchMaps& maps, int largest_cost_sum, int y, int x) {
  constexpr float kFarthest_px = 2;
  TrustFeatures f;
  f.margin = std::min(12 * maps.margin.row(y)[x] / largest_cost_sum, TrustFeatures::kMargins - 1);
  f.curvature = std::min(12 * maps.curvature.row(y)[x] / largest_cost_sum, TrustFeatures::kCurvatures - 1);
  f.residual = TrustFeatures::kResiduals - 1;
  const float d = maps.disparity.row(y)[x];
  const float column = static_cast<float>(x) - d + 0.5f;
  if (column >= 0 && column < static_cast<float>(maps.disparity.width())) {
    const float difference = std::fabs(d - maps.right_disparity.row(y)[static_cast<int>(column)]);
    if (difference < kFarthest_px) f.residual = std::min(f.residual, static_cast<int>(8 * difference));
  }
  return f;
}

Trust::Trust() {
  TrustFeatures f;
  for (f.margin = 0; f.margin < TrustFeatures::kMargins; ++f.margin)
    for (f.curvature = 0; f.curvature < TrustFeatures::kCurvatures; ++f.curvature)
      for (f.residual = 0; f.residual < TrustFeatures::kResiduals; ++f.residual)
        measured_[index(f)] = {static_cast<float>(1 / (1 + std::exp(-kLogOdds.of(f)))),
                               static_cast<float>(std::exp(kLogSigma.of(f)))};
}

void Trust::estimate(const MatchMaps& maps, int largest_cost_sum, int threads) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  confidence.resize(width, height);
  sigma_px.resize(width, height);
  const auto of = [&](int y, int x) {
    const auto state = static_cast<PixelState>(maps.state.row(y)[x]);
    return isMeasured(state) ? measured_[index(trustFeatures(maps, largest_cost_sum, y, x))]
                             : trustInFilled(state);
  };
  parallelStrips(threads, height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const Pair pair = of(y, x);
        confidence.row(y)[x] = pair.confidence;
        sigma_px.row(y)[x] = pair.sigma_px;
      }
  });
}

void Trust::reject(MatchMaps& maps, float min_confidence, int threads) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  parallelStrips(threads, confidence.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < confidence.width(); ++x) {
        std::uint8_t& state = maps.state.row(y)[x];
        if (!isMeasured(static_cast<PixelState>(state)) || confidence.row(y)[x] >= min_confidence) continue;
        state = static_cast<std::uint8_t>(PixelState::kAmbiguous);
        maps.disparity.row(y)[x] = sigma_px.row(y)[x] = kNan;
        confidence.row(y)[x] = 0;
      }
  });
}

}  // namespace pomona
