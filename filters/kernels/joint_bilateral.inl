// Joint bilateral average of a block of pixels; every lane of a vector is one output pixel.
#pragma once

namespace pomona {
namespace {

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
