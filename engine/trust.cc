#include "engine/trust.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/prefetch.h"
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
constexpr Fit kLogOdds = {2.7578, 0.16016, 0.013108, -0.088709, -0.049414, -1.3968};
constexpr Fit kLogSigma = {-1.0678, -0.082054, -0.00034835, 0.028438, 0.024229, 0.66802};
constexpr TrustPair kNothingStandsOut = {0.50f, 14.14f};

constexpr TrustPair trustInFilled(PixelState state) {
  switch (state) {
    case PixelState::kFilledPlane:
      return {0.88f, 0.41f};
    case PixelState::kFilledBackground:
      return {0.49f, 6.67f};
    case PixelState::kFilledInterpolated:
      return {0.44f, 6.30f};
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
       maps.margin(y) + x_begin,
       maps.curvature(y) + x_begin,
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

Trust::Maps Trust::estimate(MatchMaps& maps, int largest_cost_sum, const FilterKernels& kernels,
                            Arena& scratch, int threads) const {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  static_assert(sizeof(float) == 2 * sizeof(std::uint16_t));
  const Maps trust{
      {reinterpret_cast<float*>(maps.scores.row(0)), width, height, maps.scores.view().stride / 2},
      maps.right_disparity.view()};
  const Arena::Scope scope(scratch);
  const auto first_codes = scratch.image<std::uint16_t>(width, height);  // a row for every strip
  parallelStrips(threads, height, 32, [&](int y_begin, int y_end) {
    std::uint16_t* const codes = first_codes.row(y_begin);
    const auto forEachChunk = [&](auto visit) {
      for (int x = 0; x < width; x += kMatchChunk) visit(x, std::min(kMatchChunk, width - x));
    };
    for (int y = y_begin; y < y_end; ++y) {
      forEachChunk([&](int x, int count) {
        prefetch(maps.disparity.view(), y + 1, x, count);
        prefetch(maps.right_disparity.view(), y + 1, x, count);
        prefetch(maps.scores.view(), y + 1, 2 * x, 2 * count);  // margins and curvatures
        trustCodes(maps, largest_cost_sum, y, x, count, kernels, codes + x);
      });
      forEachChunk([&](int x, int count) {
        kernels.trustPairs(pairs_.data(), codes + x, maps.state.row(y) + x,
                           static_cast<std::uint8_t>(PixelState::kMeasured), count,
                           trust.confidence.row(y) + x, trust.sigma_px.row(y) + x);
      });
    }
  });
  return trust;
}

void Trust::reject(MatchMaps& maps, const Maps& trust, float min_confidence, int threads) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  parallelStrips(threads, trust.confidence.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < trust.confidence.width; ++x) {
        std::uint8_t& state = maps.state.row(y)[x];
        float& confidence = trust.confidence.at(y, x);
        if (!isMeasured(static_cast<PixelState>(state)) || confidence >= min_confidence) continue;
        state = static_cast<std::uint8_t>(PixelState::kAmbiguous);
        maps.disparity.row(y)[x] = trust.sigma_px.at(y, x) = kNan;
        confidence = 0;
      }
  });
}

}  // namespace pomona
