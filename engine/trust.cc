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
    const bool none = f.residual == kTrustSteps - 1;
    return constant + margin * f.margin + margin_squared * f.margin * f.margin + curvature * f.curvature +
           (none ? no_residual : residual * f.residual);
  }
};

// Printed by bench/confidence.
constexpr Fit kLogOdds = {2.6307, 0.16598, 0.019044, -0.083038, -0.042722, -1.3795};
constexpr Fit kLogSigma = {-0.9996, -0.10548, 0.0013102, 0.025608, 0.02155, 0.68541};
constexpr TrustPair kNothingStandsOut = {0.51f, 12.92f};

constexpr TrustPair trustInFilled(PixelState state) {
  switch (state) {
    case PixelState::kFilledPlane:
      return {0.87f, 0.44f};
    case PixelState::kFilledBackground:
      return {0.50f, 7.81f};
    case PixelState::kFilledInterpolated:
      return {0.46f, 8.00f};
    case PixelState::kFilledCoarse:
      return {0.39f, 3.69f};
    default:
      return {0.0f, std::numeric_limits<float>::quiet_NaN()};
  }
}

}  // namespace

void trustCodes(const MatchMaps& maps, int largest_cost_sum, int y, int x_begin, int count,
                const FilterKernels& kernels, std::uint16_t* codes) {
  kernels.trustCodes(
      {{maps.disparity.row(y) + x_begin, maps.right_disparity.row(y), x_begin, count, maps.disparity.width()},
       maps.margin.row(y) + x_begin,
       maps.curvature.row(y) + x_begin,
       12.0f / static_cast<float>(largest_cost_sum)},
      codes);
}

Trust::Trust() {
  for (int code = 0; code < TrustFeatures::kCodes; ++code) {
    const TrustFeatures f = TrustFeatures::of(code);
    pairs_[code] = f.bare ? kNothingStandsOut
                          : TrustPair{static_cast<float>(1 / (1 + std::exp(-kLogOdds.of(f)))),
                                      static_cast<float>(std::exp(kLogSigma.of(f)))};
  }
  for (int state = 0; state < 256; ++state)
    pairs_[TrustFeatures::kCodes + state] = trustInFilled(static_cast<PixelState>(state));
}

void Trust::estimate(const MatchMaps& maps, int largest_cost_sum, const FilterKernels& kernels, int threads) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  confidence.resize(width, height);
  sigma_px.resize(width, height);
  parallelStrips(threads, height, 32, [&](int y_begin, int y_end) {
    std::uint16_t codes[kMatchChunk];
    for (int y = y_begin; y < y_end; ++y)
      for (int begin = 0; begin < width; begin += kMatchChunk) {
        const int count = std::min(kMatchChunk, width - begin);
        trustCodes(maps, largest_cost_sum, y, begin, count, kernels, codes);
        kernels.trustPairs(pairs_.data(), codes, maps.state.row(y) + begin,
                           static_cast<std::uint8_t>(PixelState::kMeasured), count, confidence.row(y) + begin,
                           sigma_px.row(y) + begin);
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
