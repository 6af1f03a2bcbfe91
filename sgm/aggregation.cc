#include "sgm/aggregation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sgm/sweep.h"

namespace pomona {
namespace {

/// Low memory: how the rows of a half are cut into blocks, one checkpoint each. The sums of a block lie where
/// its checkpoint was, and where those of the blocks behind it were, which have been completed before: so the
/// blocks are the longer the earlier they begin, and all need the same memory.
struct Blocks {
  int count = 0;
  int* begin = nullptr;   // count + 1 of them, in rows of the half
  std::size_t bytes = 0;  // of checkpoints and sums together

  Blocks() = default;
  Blocks(int rows, const SweepPlan& plan, Arena& arena) {
    const std::size_t state = plan.stateBytes(), sums = plan.sumRowBytes();
    const auto rowsOf = [&](int block) { return static_cast<int>((bytes - block * state) / sums); };
    for (bytes = std::max(state, sums);; bytes += sums) {
      int covered = 0;
      count = 0;
      while (covered < rows && (count + 1) * state <= bytes && rowsOf(count) > 0) covered += rowsOf(count++);
      if (covered >= rows) break;
    }
    begin = arena.take<int>(static_cast<std::size_t>(count) + 1);
    begin[0] = 0;
    for (int i = 0; i < count; ++i) begin[i + 1] = std::min(rows, begin[i] + rowsOf(i));
  }
};

/// The rows that a sweep covers first, from the border of the image on, and what it leaves there.
struct Half {
  int y, step, rows;
  std::uint8_t* sums;  // of row y, or the checkpoints and sums of `blocks`
  Blocks blocks;
};

class Aggregation {
 public:
  Aggregation(const SweepPlan& plan, bool keeps_sums, WinnerSink sink, Arena& arena, int threads)
      : plan_(plan),
        keeps_sums_(keeps_sums),
        sink_(sink),
        sweep_{{plan, arena, std::max(1, threads / 2)}, {plan, arena, std::max(1, (threads + 1) / 2)}} {
    const int upper = plan.height() / 2;
    half_[0] = {0, 1, upper, nullptr, {}};
    half_[1] = {plan.height() - 1, -1, plan.height() - upper, nullptr, {}};
    for (int i = 0; i < 2; ++i) {
      Half& half = half_[i];
      if (!keeps_sums) half.blocks = Blocks(half.rows, plan, arena);
      half.sums = arena.take<std::uint8_t>(keeps_sums ? half.rows * plan.sumRowBytes() : half.blocks.bytes);
      state_[i] = arena.take<std::uint8_t>(plan.stateBytes());
      repeated_[i] = keeps_sums ? nullptr : arena.take<std::uint8_t>(plan.stateBytes());
    }
  }

  void run(int threads) {
    parallelFor(threads, 2, [&](int which) { cover(which); });
    parallelFor(threads, 2, [&](int which) { keeps_sums_ ? cross(which) : crossInBlocks(which); });
  }

 private:
  /// Rows [begin, end) of a half in the order of its own sweep.
  RowRun outward(const Half& half, int begin, int end, std::uint8_t* sums) const {
    return {half.y + begin * half.step, half.step, end - begin, sums,
            static_cast<std::ptrdiff_t>(plan_.sumRowBytes())};
  }
  static RowRun reversed(const RowRun& run) {
    return {run.y + (run.count - 1) * run.step, -run.step, run.count, run.sums + (run.count - 1) * run.stride,
            -run.stride};
  }

  void cover(int which) {
    const Half& half = half_[which];
    Sweep::clear(plan_, state_[which]);
    if (keeps_sums_) return sweep_[which].advance(outward(half, 0, half.rows, half.sums), state_[which]);
    const std::size_t bytes = plan_.stateBytes();
    for (int i = 0; i < half.blocks.count; ++i) {
      std::memcpy(half.sums + i * bytes, state_[which], bytes);
      sweep_[which].advance(outward(half, half.blocks.begin[i], half.blocks.begin[i + 1], nullptr),
                            state_[which]);
    }
  }

  void cross(int which) {
    const Half& other = half_[1 - which];
    sweep_[which].complete(reversed(outward(other, 0, other.rows, other.sums)), state_[which], sink_);
  }

  void crossInBlocks(int which) {
    const Half& other = half_[1 - which];
    const std::size_t bytes = plan_.stateBytes();
    for (int i = other.blocks.count - 1; i >= 0; --i) {
      std::uint8_t* const sums = other.sums + i * bytes;
      std::memcpy(repeated_[which], sums, bytes);
      const RowRun block = outward(other, other.blocks.begin[i], other.blocks.begin[i + 1], sums);
      sweep_[which].advance(block, repeated_[which]);
      sweep_[which].complete(reversed(block), state_[which], sink_);
    }
  }

  const SweepPlan& plan_;
  bool keeps_sums_;
  WinnerSink sink_;
  Sweep sweep_[2];
  Half half_[2];
  std::uint8_t *state_[2], *repeated_[2];
};

}  // namespace

MemoryMode chooseMemory(MemoryMode memory, double sum_bytes) {
  constexpr double kMostSumBytes = 256 << 20;
  if (memory != MemoryMode::kAutomatic) return memory;
  return sum_bytes > kMostSumBytes ? MemoryMode::kLow : MemoryMode::kSpeed;
}

void aggregate(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
               MemoryMode memory, const SgmKernels& kernels, WinnerSink sink, Arena& scratch, int threads) {
  const Arena::Scope scope(scratch);
  const SweepPlan plan(cost, steps, options, kernels, scratch);
  const double sum_bytes = static_cast<double>(plan.sumRowBytes()) * plan.height();
  const bool keeps_sums = chooseMemory(memory, sum_bytes) == MemoryMode::kSpeed;
  Aggregation(plan, keeps_sums, sink, scratch, threads).run(threads);
}

}  // namespace pomona
