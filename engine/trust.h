// How much a disparity is worth: the confidence and the sigma of every pixel.
#pragma once

#include <array>
#include <cstddef>

#include "core/image.h"
#include "sgm/matcher.h"

namespace pomona {

/// What the trust in a measured pixel rests on, each in whole steps; the last is open upwards.
struct TrustFeatures {
  static constexpr int kMargins = 16, kCurvatures = 16, kResiduals = 16;
  int margin;     ///< how far the second-best sum is above the best: in twelfths of the largest cost sum
  int curvature;  ///< of the sums at the winner: in twelfths of the largest cost sum
  int residual;   ///< |d - d_right| at the match: in px / 8; the last also if the right view knows none
};
/// `largest_cost_sum`: see Pipeline.
TrustFeatures trustFeatures(const MatchMaps& maps, int largest_cost_sum, int y, int x);

/// Fitted by bench/confidence to rendered scenes with noise, gain, blur and weak texture.
class Trust {
 public:
  struct Pair {
    float confidence, sigma_px;
  };

  Trust();

  /// Of every pixel: confidence, the probability that |d - truth| <= 1 px, 0 where d is unknown; and
  /// sigma_px, within which 68.3 % of pixels like it lie, NaN where d is unknown.
  void estimate(const MatchMaps& maps, int largest_cost_sum, int threads);

  /// Makes measured pixels of a lower confidence kAmbiguous and unknown.
  void reject(MatchMaps& maps, float min_confidence, int threads);

  Image<float> confidence, sigma_px;

 private:
  static constexpr std::size_t index(const TrustFeatures& f) {
    return static_cast<std::size_t>(
        (f.margin * TrustFeatures::kCurvatures + f.curvature) * TrustFeatures::kResiduals + f.residual);
  }
  std::array<Pair, TrustFeatures::kMargins * TrustFeatures::kCurvatures * TrustFeatures::kResiduals>
      measured_;
};

}  // namespace pomona
