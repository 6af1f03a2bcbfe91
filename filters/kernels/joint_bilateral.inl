// Joint bilateral average of a block of pixels; every lane of a vector is one output pixel.
#pragma once

namespace pomona {
namespace {

/// 2^x for x <= 0, relative error below 3e-6; arguments below -100 give 2^-100, far below any weight that
/// counts yet large enough to keep products with a disparity out of the slow denormal range.
///
/// With n = round(x), 2^x = 2^n 2^(x - n): adding 1.5 * 2^23 rounds x and leaves n in the low mantissa bits,
/// from where a shift carries it into the exponent. The polynomial is the minimax (Remez) approximation of
/// degree 4 of 2^f on [-1/2, 1/2].
inline Floats exp2NonPositive(Floats x) {
  constexpr float kRound = 12582912.0f;
  x = max(x, broadcast(-100.0f));
  const Floats shifted = x + kRound;
  const Floats f = x - (shifted - kRound);
  Floats p = f * 0.009570101908f + 0.05591786032f;
  p = p * f + 0.2402474483f;
  p = p * f + 0.6931218147f;
  p = p * f + 0.9999992614f;
  return floatsOf(bitsOf(p) + (bitsOf(shifted) << 23));
}

/// One vector of the block, `lane` pixels from its start. Rows are summed before they are added up, which
/// keeps the rounding error of long sums small.
template <int kChannels>
inline Floats jointBilateralVector(const BilateralWindow& window, int lane) {
  Floats centre[kChannels];
  centre[0] = load(window.centre + lane);
  for (int c = 1; c < kChannels; ++c) centre[c] = load(window.guide[c] + lane);

  const int radius = window.radius;
  const float* log_weight = window.log_weight;
  Floats sum = {}, weight_sum = {};
  for (int dy = -radius; dy <= radius; ++dy) {
    Floats row_sum = {}, row_weight_sum = {};
    for (int dx = -radius; dx <= radius; ++dx) {
      const std::ptrdiff_t at = dy * window.stride + dx + lane;
      Floats square = {};
      for (int c = 0; c < kChannels; ++c) {
        const Floats difference = load(window.guide[c] + at) - centre[c];
        square = c == 0 ? difference * difference : square + difference * difference;
      }
      const Floats weight = exp2NonPositive(*log_weight++ - square * window.range_scale);
      row_sum += weight * load(window.disparity + at);
      row_weight_sum += weight;
    }
    sum += row_sum;
    weight_sum += row_weight_sum;
  }
  return weight_sum >= kMinimumBilateralWeight ? sum / weight_sum : broadcast(__builtin_nanf(""));
}

void jointBilateralBlock(const BilateralWindow& window, float* out) {
  for (int lane = 0; lane < kBilateralBlock; lane += kFloatLanes)
    store(out + lane, window.channels == 1 ? jointBilateralVector<1>(window, lane)
                                           : jointBilateralVector<3>(window, lane));
}

}  // namespace
}  // namespace pomona
