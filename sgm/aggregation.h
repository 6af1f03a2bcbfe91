// Semi-global aggregation (Hirschmueller 2008, sec. 2.3), exact, in two sweeps that meet in the middle.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "core/parallel.h"
#include "pomona/options.h"
#include "sgm/cost.h"
#include "sgm/kernels.h"

namespace pomona {

/// Takes the winners of row y, which are valid until it returns. Called once for every row, in any order,
/// from up to two threads at a time.
using WinnerSink = FunctionRef<void(int y, const WinnerRow& winners)>;

/// One sweep starts at the top row, one at the bottom row. First each covers its half of the image, walking
/// its rows left to right and storing the sum of its four (two) path costs; then each crosses into the other
/// half, walking right to left, completes the sums it finds there and picks the winners. So two threads need
/// one barrier, and every pixel's sum is the same whoever computed it.
///
/// Low memory: the first pass stores no sums but, every few rows, the state of its paths (a checkpoint). The
/// sweep that crosses over restores the last checkpoint ahead of it, repeats the first pass over the rows
/// that follow it, keeping their sums, and completes those. One pass more, the same sums.
class Aggregator {
 public:
  /// `steps`: of the left image, the source of P2 adaptation.
  void run(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
           MemoryMode memory, const SgmKernels& kernels, WinnerSink sink, int threads);

  /// What kAutomatic stands for if kSpeed kept so many bytes of sums; other modes stay as they are.
  static MemoryMode chooseMemory(MemoryMode memory, double sum_bytes);

 private:
  /// What the paths of a sweep carry from row to row.
  struct Paths {
    Buffer<std::uint8_t> costs;
    Buffer<std::uint32_t> minima;
    CostRowReader cost;
  };
  struct Sweep {
    Paths paths;
    Paths repeated;  // low memory: of the other sweep's first pass
    Buffer<std::uint8_t> checkpoint_costs;
    Buffer<std::uint32_t> checkpoint_minima;
    Buffer<std::uint8_t> block_sums;  // low memory: of the rows between two checkpoints
    Buffer<std::uint16_t> recent_sums;
    Buffer<std::uint16_t> winners;  // of one row
  };
  struct Pass;

  void prepareTables(const Pass& pass);
  void restart(const Pass& pass, Paths& paths);
  void firstPass(const Pass& pass, int which);
  void lastPass(const Pass& pass, int which, WinnerSink sink);
  void lastPassInBlocks(const Pass& pass, int which, WinnerSink sink);
  AggregateRow prepareRow(const Pass& pass, Paths& paths, int y, int from_row, int from_column,
                          std::uint8_t* sums);
  WinnerRow prepareWinners(const Pass& pass, Sweep& sweep);
  void complete(const Pass& pass, Sweep& sweep, int y, int from_row, std::uint8_t* sums, WinnerSink sink);

  std::array<Sweep, 2> sweep_;
  Buffer<std::uint8_t> sums_;
  Buffer<std::uint16_t> position_, labels_, padding_, near_;
  Buffer<std::uint8_t> no_steps_;                // a row of zeros, for a constant P2
  std::array<std::uint32_t, 256> p2_of_step_{};  // quads
};

}  // namespace pomona
