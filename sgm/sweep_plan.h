// What the sweeps of a frame have in common: sizes, tables, and the kernels' view of a row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/arena.h"
#include "pomona/options.h"
#include "sgm/aggregation.h"
#include "sgm/color_steps.h"
#include "sgm/cost.h"
#include "sgm/kernels.h"

namespace pomona {

/// Buffers that are walked together lie apart modulo 4096 bytes: a load whose lower 12 address bits equal
/// those of a store in flight waits for it.
constexpr std::size_t staggered(std::size_t bytes) {
  constexpr std::size_t kPage = 4096, kStagger = 13 * 64;
  return (bytes + kPage - 1) / kPage * kPage + kStagger;
}

/// What both sweeps of a frame have in common: sizes and tables, which lie in the scope of `arena` that was
/// current when they were made. Borrows all that it is made from.
class SweepPlan {
 public:
  SweepPlan(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
            const SgmKernels& kernels, Arena& arena);

  int width() const { return cost_.width(); }
  int height() const { return cost_.height(); }
  const MatchingCostRows& cost() const { return cost_; }
  const SgmKernels& kernels() const { return kernels_; }

  std::size_t costRowBytes() const;
  std::size_t sumRowBytes() const;  ///< of the sums of one sweep
  std::size_t stateBytes() const;   ///< of what a sweep carries from row to row
  std::size_t stepsBytes() const;   ///< of the colour steps into a row, in all four directions
  bool adaptsPenalties() const { return options_.adaptation != PenaltyAdaptation::kConstant; }
  /// Whether the kernels compute costs on the way, rather than read them: if they are cheap, and nobody needs
  /// them to tell the sum of four path costs from its lowest byte.
  bool computesCosts() const {
    return cost_.areCheap() && options_.paths / 2 * (cost_.maximum() + options_.p2) < 256;
  }

  /// A whole row, without cost, border and sums. The three paths between rows come from row y + from_row, the
  /// horizontal one from column x + from_column. `steps`: room for stepsBytes() if penalties are adapted.
  AggregateRow row(int y, int from_row, int from_column, std::uint8_t* state, std::uint8_t* steps) const;
  /// Without output and scratch.
  WinnerRow winners() const;

 private:
  bool hasWideSums() const { return needsWideSums(cost_.maximum(), options_); }
  int pathsBetweenRows() const { return options_.paths == 8 ? 3 : 1; }
  int labelBits() const;
  std::size_t pathBytes() const;
  void makeWinnerTables(Arena& arena);

  const MatchingCostRows& cost_;
  const ColorSteps& steps_;
  const AggregationOptions& options_;
  const SgmKernels& kernels_;
  std::array<std::uint32_t, 256> p2_of_step_;  // quads
  const std::uint8_t* no_steps_;               // a row of zeros, for a constant P2
  std::uint16_t *position_, *labels_, *padding_, *near_;
};

}  // namespace pomona
