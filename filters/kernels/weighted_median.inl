// Colour-weighted median at chosen pixels; every lane of a vector is one of them.
#pragma once

namespace pomona {
namespace {

/// Maps the bits of a float to an integer of the same order, and back.
inline Ints orderedBits(Ints bits) {
  return bits ^ (bits >> 31 & 0x7FFFFFFF);
}

constexpr int kMedianGroup = 8;  ///< taps that are worked on side by side
constexpr int kMedianSlots = (MedianWindow::kTaps + kMedianGroup - 1) / kMedianGroup * kMedianGroup;

/// The window of each lane's pixel: ordered bits of the disparities, and their weights. Unknown disparities,
/// and the slots after the last tap, repeat the centre's key with a weight of 0.
struct WeightedTaps {
  Ints key[kMedianSlots];
  Floats weight[kMedianSlots];
};

/// kCount taps from the `first` one on.
template <int kCount>
inline void readTaps(const GuidedRow& row, const MedianWindow& window, int first, Ints columns, Ints centre,
                     Ints centre_color, WeightedTaps& taps) {
  Floats weight[kCount];
  Ints known[kCount];
#pragma GCC unroll 8
  for (int i = 0; i < kCount; ++i) {
    const std::int32_t offset = window.offset[first + i];
    const Ints bits = gather(row.disparity + offset, columns);
    const Ints difference =
        sumOfChannels(absoluteDifference(gather(row.color + offset, columns), centre_color));
    known[i] = ~isNan(floatsOf(bits));
    taps.key[first + i] = orderedBits(known[i] ? bits : centre);
    weight[i] =
        window.log_weight[first + i] - __builtin_convertvector(difference, Floats) * window.color_scale;
  }
  exp2NonPositive(weight);
#pragma GCC unroll 8
  for (int i = 0; i < kCount; ++i) taps.weight[first + i] = floatsOf(bitsOf(weight[i]) & known[i]);
}

inline void readWindow(const GuidedRow& row, const MedianWindow& window, Ints columns, WeightedTaps& taps) {
  constexpr int kTaps = MedianWindow::kTaps;
  const Ints centre = gather(row.disparity, columns), centre_color = gather(row.color, columns);
  int i = 0;
  for (; i + kMedianGroup <= kTaps; i += kMedianGroup)
    readTaps<kMedianGroup>(row, window, i, columns, centre, centre_color, taps);
  readTaps<kTaps % kMedianGroup>(row, window, i, columns, centre, centre_color, taps);
  for (i = kTaps; i < kMedianSlots; ++i) {
    taps.key[i] = orderedBits(centre);
    taps.weight[i] = Floats{};
  }
}

/// The window divided by a bound: the weights of all keys up to it, the largest of these keys, and the
/// smallest of the others.
struct DividedTaps {
  Floats weight;
  Ints last, next;
};

/// Adding in one fixed order makes the weight, though rounded, a monotone function of `bound`.
inline DividedTaps divideTaps(const WeightedTaps& taps, Ints bound) {
  const Ints lowest = Ints{} + INT32_MIN, highest = Ints{} + INT32_MAX;
  Floats sum[kMedianGroup] = {};
  Ints last = lowest, next = highest;
  for (int first = 0; first < kMedianSlots; first += kMedianGroup)
#pragma GCC unroll 8
    for (int i = 0; i < kMedianGroup; ++i) {
      const Ints key = taps.key[first + i], is_below = key <= bound;
      sum[i] += is_below ? taps.weight[first + i] : Floats{};
      last = max(last, is_below ? key : lowest);
      next = min(next, is_below ? highest : key);
    }
  for (int i = 1; i < kMedianGroup; ++i) sum[0] += sum[i];
  return {sum[0], last, next};
}

/// The smallest key up to which there is half of the weight: by bisection, each half shrunk to the keys in
/// it.
inline Ints weightedMedianKey(const WeightedTaps& taps) {
  const DividedTaps all = divideTaps(taps, Ints{} + INT32_MAX);
  const Floats half = all.weight * 0.5f;
  Ints low = taps.key[0], high = all.last;
  for (const Ints& key : taps.key) low = min(low, key);
  while (anyOf(low != high)) {
    const Ints middle = (low & high) + ((low ^ high) >> 1);
    const DividedTaps divided = divideTaps(taps, middle);
    const Ints enough = divided.weight >= half;
    high = enough ? divided.last : high;
    low = enough ? low : divided.next;
  }
  return high;
}

void weightedMedianAt(const GuidedRow& row, const MedianWindow& window, const std::int32_t* columns,
                      int count, float* out) {
  for (int begin = 0; begin < count; begin += kFloatLanes) {
    const int lanes = count - begin < kFloatLanes ? count - begin : kFloatLanes;
    Ints x;
    for (int i = 0; i < kFloatLanes; ++i) x[i] = columns[begin + (i < lanes ? i : 0)];
    WeightedTaps taps;
    readWindow(row, window, x, taps);
    const Floats median = floatsOf(orderedBits(weightedMedianKey(taps)));
    for (int i = 0; i < lanes; ++i) out[x[i]] = median[i];
  }
}

void markNearJumps(const GuidedRow& row, int width, float threshold_px, std::uint8_t* near) {
  const float* rows[3] = {row.disparity - row.stride, row.disparity, row.disparity + row.stride};
  for (int x = 0; x < width; ++x) {
    float low = rows[1][x], high = low;
    for (const float* d : rows)
      for (int dx = -1; dx <= 1; ++dx) {
        low = d[x + dx] < low ? d[x + dx] : low;
        high = d[x + dx] > high ? d[x + dx] : high;
      }
    near[x] = (high - rows[1][x] > threshold_px) | (rows[1][x] - low > threshold_px);
  }
}

}  // namespace
}  // namespace pomona
