// Semi-global aggregation (Hirschmueller 2008, sec. 2.3), exact, in two sweeps that meet in the middle.
#pragma once

#include "core/arena.h"
#include "core/parallel.h"
#include "pomona/options.h"
#include "sgm/color_steps.h"
#include "sgm/cost.h"
#include "sgm/kernels.h"

namespace pomona {

/// Takes the winners of row y, which are valid until it returns. Called once for every row, in any order,
/// from several threads at a time.
using WinnerSink = FunctionRef<void(int y, const WinnerRow& winners)>;

/// One sweep starts at the top row, one at the bottom row. First each covers its half of the image, walking
/// its rows left to right and storing the sum of its four (two) path costs; then each crosses into the other
/// half, walking right to left, completes the sums it finds there and picks the winners. So two threads need
/// one barrier, and every pixel's sum is the same whoever computed it.
///
/// Low memory: the first pass stores no sums but, every few rows, the state of its paths (a checkpoint). The
/// sweep that crosses over restores the last checkpoint ahead of it, repeats the first pass over the rows
/// that follow it, keeping their sums, and completes those. One pass more, the same sums.
///
/// More than two threads share the sweeps between them (see sgm/sweep.h).
///
/// `steps`: of the left image, the source of P2 adaptation.
void aggregate(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
               MemoryMode memory, const SgmKernels& kernels, WinnerSink sink, Arena& scratch, int threads);

/// What kAutomatic stands for if kSpeed kept so many bytes of sums; other modes stay as they are.
MemoryMode chooseMemory(MemoryMode memory, double sum_bytes);

/// Whether the sums of a sweep take two bytes: those of two paths are kept as they are, those of four modulo
/// 256, which beside the matching cost is enough if each exceeds it by 63 at most.
constexpr bool needsWideSums(int maximum_cost, const AggregationOptions& options) {
  return options.paths == 8 ? options.p2 > 63 : 2 * (maximum_cost + options.p2) > 255;
}

}  // namespace pomona
