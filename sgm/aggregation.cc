#include "sgm/aggregation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr std::uint32_t quad(int byte) {
  return static_cast<std::uint32_t>(byte) * 0x01010101u;
}

/// P2 for a colour step of 0..255.
int adaptedPenalty(const AggregationOptions& o, int step) {
  switch (o.adaptation) {
    case PenaltyAdaptation::kConstant:
      return o.p2;
    case PenaltyAdaptation::kInverseIntensity:
      return std::max(o.p1, o.p2 / std::max(step, 1));
    case PenaltyAdaptation::kSoftIntensity:
      return std::max(o.p2_min, 10 * o.p2 / (10 + step));
  }
  return o.p2;
}

}  // namespace

void WinnerMaps::resize(int width, int height) {
  for (Image<std::uint16_t>* map :
       {&index, &best, &below, &above, &second, &right_index, &right_best, &right_below, &right_above})
    map->resize(width, height);
}

struct Aggregator::Pass {
  const MatchingCostRows& cost;
  const ColorSteps& steps;
  const AggregationOptions& options;
  const SgmKernels& kernels;
  bool wide;  // 16-bit partial sums

  std::size_t rowBytes() const {
    return static_cast<std::size_t>(cost.width()) * cost.range().lanes() * (wide ? 2 : 1);
  }
  // Sweep 0 covers rows 0 .. middle - 1 first, sweep 1 the others from the bottom up.
  int middle() const { return cost.height() / 2; }
};

void Aggregator::reset(const Pass& pass, Sweep& s) {
  const int width = pass.cost.width();
  const std::size_t bytes = static_cast<std::size_t>(width + 2) * pass.cost.range().lanes();
  for (Buffer<std::uint8_t>& path : s.path) {
    path.resize(bytes);
    std::memset(path.data(), 0, bytes);
  }
  s.minima.resize(4 * static_cast<std::size_t>(width + 2));
  std::fill_n(s.minima.data(), 4 * static_cast<std::size_t>(width + 2), 0u);
  s.cost.start(pass.cost);
}

/// The steps into row y come from row y + from_row (three paths) and from column x + from_column (the
/// horizontal one).
AggregateRow Aggregator::prepareRow(const Pass& pass, Sweep& s, int y, int from_row, int from_column) {
  const int width = pass.cost.width();
  const std::uint8_t *left = no_steps_.data(), *straight = left, *right = left, *horizontal = left;
  if (pass.options.adaptation != PenaltyAdaptation::kConstant) {
    const ColorSteps& steps = pass.steps;
    const int seam =
        from_row < 0 ? y : std::min(y + 1, pass.cost.height() - 1);  // the row that holds the steps
    straight = steps.above(seam);
    // Upwards, (x - 1, y + 1) sees the step to (x, y) to its upper right, and (x + 1, y + 1) to its upper
    // left.
    left = from_row < 0 ? steps.aboveLeft(seam) : steps.aboveRight(seam) - 1;
    right = from_row < 0 ? steps.aboveRight(seam) : steps.aboveLeft(seam) + 1;
    horizontal = steps.left(y) + (from_column < 0 ? 0 : 1);
  }
  return {.width = width,
          .vectors = pass.cost.range().vectors,
          .diagonals = pass.options.paths == 8,
          .wide_sums = pass.wide,
          .cost = s.cost.row(y),
          .path = {s.path[0].data(), s.path[1].data(), s.path[2].data()},
          .minima = s.minima.data(),
          .step = {left, straight, right, horizontal},
          .p2 = p2_of_step_.data(),
          .p1 = static_cast<std::uint8_t>(pass.options.p1),
          .sums = sums_.data() + static_cast<std::size_t>(y) * pass.rowBytes()};
}

void Aggregator::firstPass(const Pass& pass, int which) {
  Sweep& s = sweep_[which];
  reset(pass, s);
  if (which == 0)
    for (int y = 0; y < pass.middle(); ++y) pass.kernels.aggregateFirst(prepareRow(pass, s, y, -1, -1));
  else
    for (int y = pass.cost.height() - 1; y >= pass.middle(); --y)
      pass.kernels.aggregateFirst(prepareRow(pass, s, y, 1, -1));
}

void Aggregator::lastPass(const Pass& pass, int which, WinnerMaps& out) {
  Sweep& s = sweep_[which];
  const DisparityRange& range = pass.cost.range();
  const int recent_pixels = static_cast<int>(std::bit_ceil(static_cast<unsigned>(range.disparities + 2)));
  s.recent_sums.resize(static_cast<std::size_t>(recent_pixels) * range.lanes());
  const auto complete = [&](int y, int from_row) {
    for (Image<std::uint16_t>* map : {&out.right_index, &out.right_best, &out.right_below, &out.right_above})
      std::fill_n(map->row(y), pass.cost.width(), kNoIndex);
    pass.kernels.aggregateLast(prepareRow(pass, s, y, from_row, 1),
                               {.disparities = range.disparities,
                                .min_disparity = range.min_disparity,
                                .position = position_.data(),
                                .labels = labels_.data(),
                                .padded = range.disparities < range.lanes(),
                                .padding = padding_.data(),
                                .index = out.index.row(y),
                                .best = out.best.row(y),
                                .below = out.below.row(y),
                                .above = out.above.row(y),
                                .second = out.second.row(y),
                                .right_index = out.right_index.row(y),
                                .right_best = out.right_best.row(y),
                                .right_below = out.right_below.row(y),
                                .right_above = out.right_above.row(y),
                                .recent = s.recent_sums.data(),
                                .recent_mask = recent_pixels - 1});
  };
  if (which == 0)
    for (int y = pass.middle(); y < pass.cost.height(); ++y) complete(y, -1);
  else
    for (int y = pass.middle() - 1; y >= 0; --y) complete(y, 1);
}

void Aggregator::run(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
                     const SgmKernels& kernels, WinnerMaps& out, int threads) {
  const DisparityRange& range = cost.range();
  const Pass pass{cost, steps, options, kernels, options.p2 > 63};
  for (int step = 0; step < 256; ++step) p2_of_step_[step] = quad(adaptedPenalty(options, step));

  no_steps_.resize(cost.width());
  std::fill_n(no_steps_.data(), cost.width(), std::uint8_t{0});
  const int lanes = range.lanes();
  position_.resize(range.disparities);
  labels_.resize(lanes);
  padding_.resize(lanes);
  for (int d = 0; d < lanes; ++d) {
    const int at = wordPosition(d, range.vectors, range.vector_bytes);
    if (d < range.disparities) position_[d] = static_cast<std::uint16_t>(at);
    labels_[at] = d < range.disparities ? static_cast<std::uint16_t>(d) : kNoIndex;
    padding_[at] = d < range.disparities ? 0 : 0xFFFF;
  }
  sums_.resize(pass.rowBytes() * cost.height());
  out.resize(cost.width(), cost.height());

  parallelFor(threads, 2, [&](int which) { firstPass(pass, which); });
  parallelFor(threads, 2, [&](int which) { lastPass(pass, which, out); });
}

}  // namespace pomona
