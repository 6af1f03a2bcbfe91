// Joint bilateral average of a block of pixels; every lane of a vector is one output pixel.
#pragma once

namespace pomona {
namespace {

/// Replaces x by 2^x, for x <= 0, with a relative error below 3e-6; arguments below -100 give 2^-100, far
/// below any weight that counts yet large enough to keep products with a disparity out of the slow denormal
/// range.
///
/// With n = round(x), 2^x = 2^n 2^(x - n): adding 1.5 * 2^23 rounds x and leaves n in the low mantissa bits,
/// from where a shift carries it into the exponent. The polynomial is the minimax (Remez) approximation of
/// degree 4 of 2^f on [-1/2, 1/2].
///
/// The vectors take every step together: one alone is a single long chain of dependent operations, several
/// side by side keep the processor busy.
template <int kCount>
inline void exp2NonPositive(Floats (&x)[kCount]) {
  constexpr float kRound = 12582912.0f;
  Floats shifted[kCount], p[kCount];
  for (Floats& v : x) v = max(v, broadcast(-100.0f));
  for (int i = 0; i < kCount; ++i) shifted[i] = x[i] + kRound;
  for (int i = 0; i < kCount; ++i) x[i] = x[i] - (shifted[i] - kRound);
  for (int i = 0; i < kCount; ++i) p[i] = x[i] * 0.009570101908f + 0.05591786032f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.2402474483f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.6931218147f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.9999992614f;
  for (int i = 0; i < kCount; ++i) x[i] = floatsOf(bitsOf(p[i]) + (bitsOf(shifted[i]) << 23));
}

struct WeightedSum {
  Floats sum = {};
  Floats weight = {};
};

/// Adds kCount neighbouring taps, the first at `at`, to `total`, one after the other.
template <int kChannels, int kCount>
inline void addTaps(const BilateralWindow& window, std::ptrdiff_t at, const float* log_weight,
                    const Floats (&centre)[kChannels], WeightedSum& total) {
  Floats weight[kCount];  // first the squared guide difference, then its exponent, at last the weight
  for (int c = 0; c < kChannels; ++c)
    for (int i = 0; i < kCount; ++i) {
      const Floats difference = load(window.guide[c] + at + i) - centre[c];
      weight[i] = c == 0 ? difference * difference : weight[i] + difference * difference;
    }
  for (int i = 0; i < kCount; ++i) weight[i] = log_weight[i] - weight[i] * window.range_scale;
  exp2NonPositive(weight);
  for (int i = 0; i < kCount; ++i) {
    total.sum = total.sum + weight[i] * load(window.disparity + at + i);
    total.weight = total.weight + weight[i];
  }
}

/// One vector of the block, `lane` pixels from its start. Rows are summed before they are added up, which
/// keeps the rounding error of long sums small.
template <int kChannels>
inline Floats jointBilateralVector(const BilateralWindow& window, int lane) {
  Floats centre[kChannels];
  centre[0] = load(window.centre + lane);
  for (int c = 1; c < kChannels; ++c) centre[c] = load(window.guide[c] + lane);

  constexpr int kTaps = 8;
  const float* log_weight = window.log_weight;
  WeightedSum total;
  for (int dy = -window.radius; dy <= window.radius; ++dy) {
    WeightedSum row;
    std::ptrdiff_t at = dy * window.stride - window.radius + lane;
    int left = 2 * window.radius + 1;
    for (; left >= kTaps; left -= kTaps, at += kTaps, log_weight += kTaps)
      addTaps<kChannels, kTaps>(window, at, log_weight, centre, row);
    for (; left > 0; --left, ++at, ++log_weight) addTaps<kChannels, 1>(window, at, log_weight, centre, row);
    total.sum = total.sum + row.sum;
    total.weight = total.weight + row.weight;
  }
  return total.weight >= kMinimumBilateralWeight ? total.sum / total.weight : broadcast(__builtin_nanf(""));
}

void jointBilateralBlock(const BilateralWindow& window, float* out) {
  for (int lane = 0; lane < kBilateralBlock; lane += kFloatLanes)
    store(out + lane, window.channels == 1 ? jointBilateralVector<1>(window, lane)
                                           : jointBilateralVector<3>(window, lane));
}

}  // namespace
}  // namespace pomona
