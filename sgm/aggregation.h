// Semi-global aggregation (Hirschmueller 2008, sec. 2.3), exact, in two sweeps that meet in the middle.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "pomona/options.h"
#include "sgm/cost.h"
#include "sgm/kernels.h"

namespace pomona {

/// What winner-take-all leaves for every pixel; WinnerRow names the fields. All of the image's size.
struct WinnerMaps {
  Image<std::uint16_t> index, best, below, above, second, right_index, right_best, right_below, right_above;

  void resize(int width, int height);
};

/// One sweep starts at the top row, one at the bottom row. First each covers its half of the image, walking
/// its rows left to right and storing the sum of its four (two) path costs; then each crosses into the other
/// half, walking right to left, completes the sums it finds there and picks the winners. So two threads need
/// one barrier, and every pixel's sum is the same whoever computed it.
class Aggregator {
 public:
  /// `steps`: of the left image, the source of P2 adaptation.
  void run(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
           const SgmKernels& kernels, WinnerMaps& out, int threads);

 private:
  struct Sweep {
    std::array<Buffer<std::uint8_t>, 3> path;
    Buffer<std::uint32_t> minima;
    CostRowReader cost;
    Buffer<std::uint16_t> recent_sums;
  };
  struct Pass;

  void reset(const Pass& pass, Sweep& sweep);
  void firstPass(const Pass& pass, int which);
  void lastPass(const Pass& pass, int which, WinnerMaps& out);
  AggregateRow prepareRow(const Pass& pass, Sweep& sweep, int y, int from_row, int from_column);

  std::array<Sweep, 2> sweep_;
  Buffer<std::uint8_t> sums_;
  Buffer<std::uint16_t> position_, labels_, padding_;
  Buffer<std::uint8_t> no_steps_;                // a row of zeros, for a constant P2
  std::array<std::uint32_t, 256> p2_of_step_{};  // quads
};

}  // namespace pomona
