#include "sgm/sweep_plan.h"

#include <algorithm>
#include <bit>

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
  return pathsBetweenRows() * pathBytes() + (minima + 63) / 64 * 64;
}
std::size_t SweepPlan::stepsBytes() const {
  return 4 * staggered(static_cast<std::size_t>(width() + 2));
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
  const int shared = sharedBits(lanes, labelBits());
  for (int d = 0; d < lanes; ++d) {
    labels_[at(d)] = d <= last ? static_cast<std::uint16_t>(d >> shared) : kNoIndex;
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

AggregateRow SweepPlan::row(int y, int from_row, int from_column, std::uint8_t* state,
                            std::uint8_t* steps) const {
  const std::uint8_t *left = no_steps_, *straight = left, *right = left, *horizontal = left;
  if (adaptsPenalties()) {
    const auto room = [&](int i) { return steps + i * (stepsBytes() / 4); };
    const int seam = from_row < 0 ? y : std::min(y + 1, height() - 1);  // the row that holds the steps
    steps_.between(seam, y,
                   {.left = room(3), .above = room(1), .above_left = room(0), .above_right = room(2)});
    straight = room(1) + 1;
    // Upwards, (x - 1, y + 1) sees the step to (x, y) to its upper right, and (x + 1, y + 1) to its upper
    // left.
    left = from_row < 0 ? room(0) + 1 : room(2);
    right = from_row < 0 ? room(2) + 1 : room(0) + 2;
    horizontal = room(3) + (from_column < 0 ? 1 : 2);
  }
  const bool diagonals = options_.paths == 8;
  std::uint8_t* const straight_path = diagonals ? state + pathBytes() : state;
  return {.width = width(),
          .vectors = cost_.range().vectors,
          .begin = 0,
          .end = width(),
          .border = nullptr,
          .diagonals = diagonals,
          .wide_sums = hasWideSums(),
          .cost = nullptr,
          .census = computesCosts() ? cost_.censusRow(y, nullptr) : CensusCostRow{},
          .path = {state, straight_path, diagonals ? straight_path + pathBytes() : state},
          .minima = reinterpret_cast<std::uint32_t*>(state + pathsBetweenRows() * pathBytes()),
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
  row.shared_bits = sharedBits(range.lanes(), row.label_bits);
  row.near = near_;
  row.padded = range.disparities < range.lanes();
  row.padding = padding_;
  const unsigned recent_pixels = static_cast<unsigned>(range.disparities + 2 + kWinnerBlock);
  row.recent_mask = static_cast<int>(std::bit_ceil(recent_pixels)) - 1;
  return row;
}

}  // namespace pomona
