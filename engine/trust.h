// How much a disparity is worth: the confidence and the sigma of every pixel.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "filters/kernels.h"
#include "sgm/matcher.h"

namespace pomona {

/// What the trust in a measured pixel rests on, each in whole steps; the last is open upwards.
struct TrustFeatures {
  static constexpr int kCodes = kTrustCodes;
  int margin;     ///< how far the second-best sum is above the best: in twelfths of the largest cost sum
  int curvature;  ///< of the sums at the winner: in twelfths of the largest cost sum
  int residual;   ///< |d - d_right| at the match: in px / 8; the last also if the right view knows none
  bool bare;      ///< no disparity stands out: a margin below half a step, and a curvature below one

  static constexpr TrustFeatures of(int code) {
    const int step = code / (kTrustSteps * kTrustSteps), curvature = code / kTrustSteps % kTrustSteps;
    return {step > 0 ? step - 1 : 0, curvature, code % kTrustSteps, step == 0 && curvature == 0};
  }
};

/// TrustFeatures::bare, of a margin and a curvature as the matcher gives them.
constexpr bool nothingStandsOut(int margin, int curvature, int largest_cost_sum) {
  return 24 * margin < largest_cost_sum && 12 * curvature < largest_cost_sum;
}

/// The features of up to kMatchChunk pixels from (x_begin, y) on, as codes. `largest_cost_sum`: see Pipeline.
void trustCodes(const MatchMaps& maps, int largest_cost_sum, int y, int x_begin, int count,
                const FilterKernels& kernels, std::uint16_t* codes);

/// Fitted by bench/confidence to rendered scenes with noise, gain, blur and weak texture.
class Trust {
 public:
  Trust();

  /// Of every pixel: confidence, the probability that |d - truth| <= 1 px, 0 where d is unknown; and
  /// sigma_px, within which 68.3 % of pixels like it lie, NaN where d is unknown.
  void estimate(const MatchMaps& maps, int largest_cost_sum, const FilterKernels& kernels, int threads);

  /// Makes measured pixels of a lower confidence kAmbiguous and unknown.
  void reject(MatchMaps& maps, float min_confidence, int threads);

  Image<float> confidence, sigma_px;

 private:
  std::array<TrustPair, TrustFeatures::kCodes + 256> pairs_;  // of measured pixels, by code; others, by state
};

}  // namespace pomona
