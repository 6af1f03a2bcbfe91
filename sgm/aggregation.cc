#include "sgm/aggregation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

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

/// Buffers that are walked together lie apart modulo 4096 bytes: a load whose lower 12 address bits equal
/// those of a store in flight waits for it.
constexpr std::size_t kPage = 4096, kStagger = 13 * 64;
std::size_t staggered(std::size_t bytes) {
  return (bytes + kPage - 1) / kPage * kPage + kStagger;
}

}  // namespace

struct Aggregator::Pass {
  const MatchingCostRows& cost;
  const ColorSteps& steps;
  const AggregationOptions& options;
  const SgmKernels& kernels;
  MemoryMode memory;

  bool wide() const { return options.p2 > 63; }  // 16-bit partial sums
  bool keepsSums() const { return memory == MemoryMode::kSpeed; }
  int labelBits() const {
    const int largest_sum = options.paths * (cost.maximum() + options.p2);
    return wide() ? 0 : pomona::labelBits(cost.range().lanes(), largest_sum);
  }
  bool computesCosts() const { return cost.areCheap() && options.paths == 8 && !wide(); }
  int height() const { return cost.height(); }
  std::size_t sumRowBytes() const {
    return static_cast<std::size_t>(cost.width()) * cost.range().lanes() * (wide() ? 2 : 1);
  }
  // With a guard pixel at either end.
  std::size_t pathBytes() const {
    return staggered(static_cast<std::size_t>(cost.width() + 2) * cost.range().lanes());
  }
  std::size_t minimaCount() const { return 4 * static_cast<std::size_t>(cost.width() + 2); }

  // Sweep 0 covers rows 0 .. height / 2 - 1 first, sweep 1 the others from the bottom up.
  int rowsOf(int which) const { return which == 0 ? height() / 2 : height() - height() / 2; }
  int rowAt(int which, int i) const { return which == 0 ? i : height() - 1 - i; }
  static int fromRow(int which) { return which == 0 ? -1 : 1; }

  /// Rows from one checkpoint to the next: what the checkpoints take and what a block's sums take are then
  /// about equal, which makes both together smallest.
  int blockRows() const {
    const double state = 3.0 * static_cast<double>(pathBytes()), sums = static_cast<double>(sumRowBytes());
    return std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * height() * state / sums))));
  }
};

MemoryMode Aggregator::chooseMemory(MemoryMode memory, double sum_bytes) {
  constexpr double kMostSumBytes = 256 << 20;
  if (memory != MemoryMode::kAutomatic) return memory;
  return sum_bytes > kMostSumBytes ? MemoryMode::kLow : MemoryMode::kSpeed;
}

void Aggregator::restart(const Pass& pass, Paths& paths) {
  paths.costs.resize(3 * pass.pathBytes());
  std::memset(paths.costs.data(), 0, 3 * pass.pathBytes());
  paths.minima.resize(pass.minimaCount());
  std::fill_n(paths.minima.data(), pass.minimaCount(), 0u);
  paths.cost.start(pass.cost);
}

/// The steps into row y come from row y + from_row (three paths) and from column x + from_column (the
/// horizontal one).
AggregateRow Aggregator::prepareRow(const Pass& pass, Paths& paths, int y, int from_row, int from_column,
                                    std::uint8_t* sums) {
  const std::uint8_t *left = no_steps_.data(), *straight = left, *right = left, *horizontal = left;
  if (pass.options.adaptation != PenaltyAdaptation::kConstant) {
    const ColorSteps& steps = pass.steps;
    const int seam = from_row < 0 ? y : std::min(y + 1, pass.height() - 1);  // the row that holds the steps
    straight = steps.above(seam);
    // Upwards, (x - 1, y + 1) sees the step to (x, y) to its upper right, and (x + 1, y + 1) to its upper
    // left.
    left = from_row < 0 ? steps.aboveLeft(seam) : steps.aboveRight(seam) - 1;
    right = from_row < 0 ? steps.aboveRight(seam) : steps.aboveLeft(seam) + 1;
    horizontal = steps.left(y) + (from_column < 0 ? 0 : 1);
  }
  const bool computed = pass.computesCosts();
  std::uint8_t* path = paths.costs.data();
  const std::size_t path_bytes = pass.pathBytes();
  return {.width = pass.cost.width(),
          .vectors = pass.cost.range().vectors,
          .diagonals = pass.options.paths == 8,
          .wide_sums = pass.wide(),
          .cost = computed ? nullptr : paths.cost.row(y),
          .census = computed ? pass.cost.censusRow(y, nullptr) : CensusCostRow{},
          .path = {path, path + path_bytes, path + 2 * path_bytes},
          .minima = paths.minima.data(),
          .step = {left, straight, right, horizontal},
          .p2 = p2_of_step_.data(),
          .p1 = static_cast<std::uint8_t>(pass.options.p1),
          .sums = sums};
}

void Aggregator::firstPass(const Pass& pass, int which) {
  Sweep& s = sweep_[which];
  restart(pass, s.paths);
  const bool keeps_sums = pass.keepsSums();
  const int rows = pass.rowsOf(which), block = pass.blockRows();
  const std::size_t costs = 3 * pass.pathBytes(), minima = pass.minimaCount();
  if (!keeps_sums) {
    const std::size_t checkpoints = static_cast<std::size_t>(rows / block + 1);
    s.checkpoint_costs.resize(checkpoints * costs);
    s.checkpoint_minima.resize(checkpoints * minima);
    s.block_sums.resize(static_cast<std::size_t>(block) * pass.sumRowBytes());
  }
  for (int i = 0; i < rows; ++i) {
    const int y = pass.rowAt(which, i);
    if (!keeps_sums && i % block == 0) {
      std::memcpy(s.checkpoint_costs.data() + i / block * costs, s.paths.costs.data(), costs);
      std::copy_n(s.paths.minima.data(), minima, s.checkpoint_minima.data() + i / block * minima);
    }
    std::uint8_t* sums = keeps_sums ? sums_.data() + y * pass.sumRowBytes() : s.block_sums.data();
    pass.kernels.aggregateFirst(prepareRow(pass, s.paths, y, Pass::fromRow(which), -1, sums));
  }
}

WinnerRow Aggregator::prepareWinners(const Pass& pass, Sweep& s) {
  const DisparityRange& range = pass.cost.range();
  const int recent_pixels =
      static_cast<int>(std::bit_ceil(static_cast<unsigned>(range.disparities + 2 + kWinnerBlock)));
  s.recent_sums.resize(static_cast<std::size_t>(recent_pixels) * range.lanes());
  const std::size_t step = staggered(sizeof(std::uint16_t) * pass.cost.width()) / sizeof(std::uint16_t);
  s.winners.resize(9 * step);
  const auto row = [&](int k) { return s.winners.data() + k * step; };
  for (std::uint16_t* none : {row(5), row(6)}) std::fill_n(none, pass.cost.width(), kNoIndex);
  return {.disparities = range.disparities,
          .min_disparity = range.min_disparity,
          .position = position_.data() + 1,
          .index_mask = winnerIndexMask(range.disparities),
          .labels = labels_.data(),
          .label_bits = pass.labelBits(),
          .near = near_.data(),
          .padded = range.disparities < range.lanes(),
          .padding = padding_.data(),
          .index = row(0),
          .best = row(1),
          .below = row(2),
          .above = row(3),
          .second = row(4),
          .right_index = row(5),
          .right_best = row(6),
          .right_below = row(7),
          .right_above = row(8),
          .recent = s.recent_sums.data(),
          .recent_mask = recent_pixels - 1};
}

/// Completes the sums of row y, which hold those of the other sweep.
void Aggregator::complete(const Pass& pass, Sweep& s, int y, int from_row, std::uint8_t* sums,
                          WinnerSink sink) {
  const WinnerRow winners = prepareWinners(pass, s);
  pass.kernels.aggregateLast(prepareRow(pass, s.paths, y, from_row, 1, sums), winners);
  sink(y, winners);
}

void Aggregator::lastPass(const Pass& pass, int which, WinnerSink sink) {
  const int other = 1 - which;
  for (int i = pass.rowsOf(other) - 1; i >= 0; --i) {
    const int y = pass.rowAt(other, i);
    complete(pass, sweep_[which], y, Pass::fromRow(which), sums_.data() + y * pass.sumRowBytes(), sink);
  }
}

void Aggregator::lastPassInBlocks(const Pass& pass, int which, WinnerSink sink) {
  Sweep& s = sweep_[which];
  const int other = 1 - which;
  const Sweep& crossed = sweep_[other];
  const int rows = pass.rowsOf(other), block = pass.blockRows();
  const std::size_t costs = 3 * pass.pathBytes(), minima = pass.minimaCount();
  restart(pass, s.repeated);
  s.block_sums.resize(static_cast<std::size_t>(block) * pass.sumRowBytes());
  const auto sumsOf = [&](int i) { return s.block_sums.data() + i % block * pass.sumRowBytes(); };
  for (int begin = (rows - 1) / block * block; begin >= 0 && rows > 0; begin -= block) {
    const int end = std::min(rows, begin + block);
    std::memcpy(s.repeated.costs.data(), crossed.checkpoint_costs.data() + begin / block * costs, costs);
    std::copy_n(crossed.checkpoint_minima.data() + begin / block * minima, minima, s.repeated.minima.data());
    for (int i = begin; i < end; ++i)
      pass.kernels.aggregateFirst(
          prepareRow(pass, s.repeated, pass.rowAt(other, i), Pass::fromRow(other), -1, sumsOf(i)));
    for (int i = end - 1; i >= begin; --i)
      complete(pass, s, pass.rowAt(other, i), Pass::fromRow(which), sumsOf(i), sink);
  }
}

void Aggregator::prepareTables(const Pass& pass) {
  const DisparityRange& range = pass.cost.range();
  for (int step = 0; step < 256; ++step) p2_of_step_[step] = quad(adaptedPenalty(pass.options, step));
  no_steps_.resize(pass.cost.width());
  std::fill_n(no_steps_.data(), pass.cost.width(), std::uint8_t{0});

  const int lanes = range.lanes(), last = range.disparities - 1;
  const auto at = [&](int d) {
    return static_cast<std::uint16_t>(wordPosition(d, range.vectors, range.vector_bytes));
  };
  const int positions = winnerIndexMask(range.disparities) + 1;
  position_.resize(positions + 2);
  for (int d = -1; d <= positions; ++d) position_[d + 1] = at(std::clamp(d, 0, last));
  labels_.resize(lanes);
  padding_.resize(lanes);
  for (int d = 0; d < lanes; ++d) {
    labels_[at(d)] = d <= last ? static_cast<std::uint16_t>(d) : kNoIndex;
    padding_[at(d)] = d <= last ? 0 : 0xFFFF;
  }

  if (pass.labelBits() == 0) return;
  const std::size_t words = static_cast<std::size_t>(range.disparities) * lanes;
  near_.resize(words);
  std::fill_n(near_.data(), words, std::uint16_t{0});
  for (int d = 0; d <= last; ++d)
    for (int e = std::max(0, d - 1); e <= std::min(last, d + 1); ++e) near_[d * lanes + at(e)] = 0xFFFF;
}

void Aggregator::run(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
                     MemoryMode memory, const SgmKernels& kernels, WinnerSink sink, int threads) {
  Pass pass{cost, steps, options, kernels, memory};
  const std::size_t sum_bytes = pass.sumRowBytes() * static_cast<std::size_t>(pass.height());
  pass.memory = chooseMemory(memory, static_cast<double>(sum_bytes));
  prepareTables(pass);
  if (pass.keepsSums()) sums_.resize(sum_bytes);
  parallelFor(threads, 2, [&](int which) { firstPass(pass, which); });
  parallelFor(threads, 2, [&](int which) {
    pass.keepsSums() ? lastPass(pass, which, sink) : lastPassInBlocks(pass, which, sink);
  });
}

}  // namespace pomona
