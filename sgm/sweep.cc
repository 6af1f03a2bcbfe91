#include "sgm/sweep.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

namespace pomona {
namespace {

constexpr int kGroupRows = 4;  // more of them cost more, as does a narrow tile; see docs/simd.md
constexpr int kMostTileColumns = 128;

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

SweepPlan::SweepPlan(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
                     const SgmKernels& kernels, Arena& arena)
    : cost_(cost), steps_(steps), options_(options), kernels_(kernels) {
  for (int step = 0; step < 256; ++step) p2_of_step_[step] = quad(adaptedPenalty(options, step));
  std::uint8_t* const no_steps = arena.take<std::uint8_t>(width());
  std::fill_n(no_steps, width(), std::uint8_t{0});
  no_steps_ = no_steps;
  makeWinnerTables(arena);
}

int SweepPlan::labelBits() const {
  const int largest_sum = options_.paths * (cost_.maximum() + options_.p2);
  return hasWideSums() ? 0 : pomona::labelBits(cost_.range().lanes(), largest_sum);
}
std::size_t SweepPlan::costRowBytes() const {
  return static_cast<std::size_t>(width()) * cost_.range().lanes();
}
std::size_t SweepPlan::sumRowBytes() const {
  return costRowBytes() * (hasWideSums() ? 2 : 1);
}
// With a guard pixel at either end.
std::size_t SweepPlan::pathBytes() const {
  return staggered(static_cast<std::size_t>(width() + 2) * cost_.range().lanes());
}
std::size_t SweepPlan::stateBytes() const {
  const std::size_t minima = 4 * sizeof(std::uint32_t) * static_cast<std::size_t>(width() + 2);
  return 3 * pathBytes() + (minima + 63) / 64 * 64;
}
std::size_t SweepPlan::stepRowBytes() const {
  return staggered(static_cast<std::size_t>(width() + 2));
}
int SweepPlan::recentPixels() const {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(cost_.range().disparities + 2 + kWinnerBlock)));
}

void SweepPlan::makeWinnerTables(Arena& arena) {
  const DisparityRange& range = cost_.range();
  const int lanes = range.lanes(), last = range.disparities - 1;
  const auto at = [&](int d) {
    return static_cast<std::uint16_t>(wordPosition(d, range.vectors, range.vector_bytes));
  };
  const int positions = winnerIndexMask(range.disparities) + 1;
  position_ = arena.take<std::uint16_t>(positions + 2);
  for (int d = -1; d <= positions; ++d) position_[d + 1] = at(std::clamp(d, 0, last));
  labels_ = arena.take<std::uint16_t>(lanes);
  padding_ = arena.take<std::uint16_t>(lanes);
  for (int d = 0; d < lanes; ++d) {
    labels_[at(d)] = d <= last ? static_cast<std::uint16_t>(d) : kNoIndex;
    padding_[at(d)] = d <= last ? 0 : 0xFFFF;
  }

  near_ = nullptr;
  if (labelBits() == 0) return;
  const std::size_t words = static_cast<std::size_t>(range.disparities) * lanes;
  near_ = arena.take<std::uint16_t>(words);
  std::fill_n(near_, words, std::uint16_t{0});
  for (int d = 0; d <= last; ++d)
    for (int e = std::max(0, d - 1); e <= std::min(last, d + 1); ++e) near_[d * lanes + at(e)] = 0xFFFF;
}

/// The steps into row y come from row y + from_row (three paths) and from column x + from_column (the
/// horizontal one). `steps`: room for 4 stepRowBytes().
AggregateRow SweepPlan::row(int y, int from_row, int from_column, std::uint8_t* state,
                            std::uint8_t* steps) const {
  const std::uint8_t *left = no_steps_, *straight = left, *right = left, *horizontal = left;
  if (adaptsPenalties()) {
    const auto room = [&](int i) { return steps + i * stepRowBytes(); };
    const int seam = from_row < 0 ? y : std::min(y + 1, height() - 1);  // the row that holds the steps
    steps_.aboveLeft(seam, room(0));
    steps_.above(seam, room(1));
    steps_.aboveRight(seam, room(2));
    steps_.left(y, room(3));
    straight = room(1) + 1;
    // Upwards, (x - 1, y + 1) sees the step to (x, y) to its upper right, and (x + 1, y + 1) to its upper
    // left.
    left = from_row < 0 ? room(0) + 1 : room(2);
    right = from_row < 0 ? room(2) + 1 : room(0) + 2;
    horizontal = room(3) + (from_column < 0 ? 1 : 2);
  }
  return {.width = width(),
          .vectors = cost_.range().vectors,
          .begin = 0,
          .end = width(),
          .border = nullptr,
          .diagonals = options_.paths == 8,
          .wide_sums = hasWideSums(),
          .cost = nullptr,
          .census = computesCosts() ? cost_.censusRow(y, nullptr) : CensusCostRow{},
          .path = {state, state + pathBytes(), state + 2 * pathBytes()},
          .minima = reinterpret_cast<std::uint32_t*>(state + 3 * pathBytes()),
          .step = {left, straight, right, horizontal},
          .p2 = p2_of_step_.data(),
          .p1 = static_cast<std::uint8_t>(options_.p1),
          .sums = nullptr};
}

WinnerRow SweepPlan::winners() const {
  const DisparityRange& range = cost_.range();
  WinnerRow row{};
  row.disparities = range.disparities;
  row.min_disparity = range.min_disparity;
  row.position = position_ + 1;
  row.index_mask = winnerIndexMask(range.disparities);
  row.labels = labels_;
  row.label_bits = labelBits();
  row.near = near_;
  row.padded = range.disparities < range.lanes();
  row.padding = padding_;
  row.recent_mask = recentPixels() - 1;
  return row;
}

struct Sweep::Lane {
  struct Row {
    std::uint8_t* cost = nullptr;  // null if costs are computed on the way
    std::uint8_t *steps = nullptr, *border = nullptr;
    WinnerRow winners;
  };

  void prepare(const SweepPlan& plan, int group_rows, Arena& arena);

  CostRowReader cost;
  std::uint8_t* unwanted_sums = nullptr;
  std::array<Row, kGroupRows> rows;
  int occupied = 0;  // shared
};

void Sweep::Lane::prepare(const SweepPlan& plan, int group_rows, Arena& arena) {
  const DisparityRange& range = plan.cost_.range();
  cost = CostRowReader(plan.cost_, arena);
  unwanted_sums = arena.take<std::uint8_t>(plan.sumRowBytes());
  const std::size_t step = staggered(sizeof(std::uint16_t) * plan.width()) / sizeof(std::uint16_t);
  for (int i = 0; i < group_rows; ++i) {
    Row& row = rows[i];
    if (plan.adaptsPenalties()) row.steps = arena.take<std::uint8_t>(4 * plan.stepRowBytes());
    if (!plan.computesCosts()) row.cost = arena.take<std::uint8_t>(plan.costRowBytes());
    WinnerRow& w = row.winners;
    w = plan.winners();
    for (std::uint16_t** out : {&w.index, &w.best, &w.below, &w.above, &w.second, &w.right_index,
                                &w.right_best, &w.right_below, &w.right_above})
      *out = arena.take<std::uint16_t>(step);
    w.recent = arena.take<std::uint16_t>(static_cast<std::size_t>(w.recent_mask + 1) * range.lanes());
    if (group_rows == 1) continue;
    row.border = arena.take<std::uint8_t>(aggregateBorderBytes(range.vectors, range.vector_bytes));
    w.right_border = arena.take<std::uint16_t>(4 * range.lanes());
  }
}

struct Sweep::Walk {
  const RowRun& run;
  std::uint8_t* state;
  const WinnerSink* sink;  // null: the first pass
  int tile_columns, tiles;
};

Sweep::Sweep(const SweepPlan& plan, Arena& arena, int threads)
    : plan_(plan), threads_(threads), group_rows_(threads > 1 ? kGroupRows : 1) {
  lanes_ = arena.take<Lane>(threads);
  for (int i = 0; i < threads; ++i) {
    lanes_[i] = Lane();
    lanes_[i].prepare(plan, group_rows_, arena);
  }
  progress_ = arena.take<TaskProgress>(plan.height());  // of as many groups as there may be
}

void Sweep::clear(const SweepPlan& plan, std::uint8_t* state) {
  std::memset(state, 0, plan.stateBytes());
}

void Sweep::advance(const RowRun& run, std::uint8_t* state) {
  walk(run, state, nullptr);
}

void Sweep::complete(const RowRun& run, std::uint8_t* state, WinnerSink sink) {
  walk(run, state, &sink);
}

void Sweep::walk(const RowRun& run, std::uint8_t* state, const WinnerSink* sink) {
  const int width = plan_.width(), groups = (run.count + group_rows_ - 1) / group_rows_;
  const int columns =
      group_rows_ == 1 ? width : std::clamp(width / (2 * threads_), group_rows_, kMostTileColumns);
  const Walk walk{run, state, sink, columns, (width + group_rows_ - 1 + columns - 1) / columns};
  std::fill_n(progress_, groups, TaskProgress());
  parallelFor(threads_, groups, [&](int group) { walkGroup(walk, group); });
}

Sweep::Lane& Sweep::enterLane() {
  for (int i = 0;; i = (i + 1) % threads_) {
    int no = 0;
    if (std::atomic_ref(lanes_[i].occupied).compare_exchange_strong(no, 1, std::memory_order_acquire))
      return lanes_[i];
  }
}

void Sweep::walkGroup(const Walk& walk, int group) {
  const RowRun& run = walk.run;
  const int first = group * group_rows_, rows = std::min(group_rows_, run.count - first);
  const int width = plan_.width();
  Lane& lane = enterLane();
  AggregateRow paths[kGroupRows];
  for (int i = 0; i < rows; ++i) {
    const int y = run.y + (first + i) * run.step;
    const Lane::Row& row = lane.rows[i];
    paths[i] = plan_.row(y, -run.step, walk.sink ? 1 : -1, walk.state, row.steps);
    if (row.cost) lane.cost.row(y, row.cost);
    paths[i].cost = row.cost;
    paths[i].border = row.border;
    paths[i].sums = run.sums ? run.sums + (first + i) * run.stride : lane.unwanted_sums;
    for (std::uint16_t* none : {row.winners.right_index, row.winners.right_best})
      if (walk.sink) std::fill_n(none, width, kNoIndex);
  }

  for (int tile = 0; tile < walk.tiles; ++tile) {
    if (group > 0) progress_[group - 1].await(std::min(tile + 2, walk.tiles));
    for (int i = 0; i < rows; ++i) {
      const auto edge = [&](int t) {
        return t == walk.tiles ? width : std::clamp(t * walk.tile_columns - i, 0, width);
      };
      const int begin = edge(tile), end = edge(tile + 1);
      if (begin == end) continue;
      paths[i].begin = walk.sink ? width - end : begin;
      paths[i].end = walk.sink ? width - begin : end;
      walk.sink ? plan_.kernels_.aggregateLast(paths[i], lane.rows[i].winners)
                : plan_.kernels_.aggregateFirst(paths[i]);
    }
    progress_[group].reach(tile + 1);
  }
  for (int i = 0; walk.sink && i < rows; ++i)
    (*walk.sink)(run.y + (first + i) * run.step, lane.rows[i].winners);
  std::atomic_ref(lane.occupied).store(0, std::memory_order_release);
}

}  // namespace pomona
