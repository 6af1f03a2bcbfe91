#include "sgm/sweep.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace pomona {
namespace {

constexpr int kGroupRows = 4;        // more of them cost more, as does a narrow tile; see docs/simd.md
constexpr int kGroupsPerThread = 2;  // at least, in a half of the image
constexpr int kMostTileColumns = 128;

}  // namespace

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
  const DisparityRange& range = plan.cost().range();
  cost = CostRowReader(plan.cost(), arena);
  unwanted_sums = arena.take<std::uint8_t>(plan.sumRowBytes());
  const std::size_t step = staggered(sizeof(std::uint16_t) * plan.width()) / sizeof(std::uint16_t);
  for (int i = 0; i < group_rows; ++i) {
    Row& row = rows[i];
    if (plan.adaptsPenalties()) row.steps = arena.take<std::uint8_t>(plan.stepsBytes());
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
    : plan_(plan),
      threads_(std::clamp(threads, 1, std::max(1, plan.height() / (2 * kGroupsPerThread * kGroupRows)))),
      group_rows_(threads_ > 1 ? kGroupRows : 1) {
  lanes_ = arena.take<Lane>(threads_);
  for (int i = 0; i < threads_; ++i) {
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
      walk.sink ? plan_.kernels().aggregateLast(paths[i], lane.rows[i].winners)
                : plan_.kernels().aggregateFirst(paths[i]);
    }
    progress_[group].reach(tile + 1);
  }
  for (int i = 0; walk.sink && i < rows; ++i)
    (*walk.sink)(run.y + (first + i) * run.step, lane.rows[i].winners);
  std::atomic_ref(lane.occupied).store(0, std::memory_order_release);
}

}  // namespace pomona
