#include "baselines/winner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// The vertex of the parabola through a cost and its neighbours; 0 where one of these is missing.
float parabolaOffset(const float* cost, int at, int count) {
  if (at == 0 || at + 1 == count) return 0;
  const float before = cost[at - 1], after = cost[at + 1];
  const float curvature = before + after - 2 * cost[at];
  return curvature > 0 && curvature < kNone ? (before - after) / (2 * curvature) : 0;
}

/// The smallest cost at least two disparities from `winner`.
float secondBest(const float* cost, int count, int winner) {
  float best = kNone;
  for (int i = 0; i < winner - 1; ++i) best = std::min(best, cost[i]);
  for (int i = winner + 2; i < count; ++i) best = std::min(best, cost[i]);
  return best;
}

void pickLeft(const float* cost, int width, SearchRange range, WinnerPosition position, int y,
              WindowMaps& maps) {
  const bool refine = position == WinnerPosition::kParabola;
  for (int x = 0; x < width; ++x, cost += range.count) {
    const int winner = static_cast<int>(std::min_element(cost, cost + range.count) - cost);
    const bool in_view = cost[winner] < kNone;
    const float second = in_view ? secondBest(cost, range.count, winner) : kNone;
    maps.state.row(y)[x] =
        static_cast<std::uint8_t>(in_view ? PixelState::kMeasured : PixelState::kOutOfRange);
    const float offset = in_view && refine ? parabolaOffset(cost, winner, range.count) : 0;
    maps.disparity.row(y)[x] = in_view ? static_cast<float>(range.min + winner) + offset : kUnknown;
    maps.confidence.row(y)[x] = second > 0 && second < kNone ? 1 - cost[winner] / second : 0;
  }
}

/// The costs of a right pixel lie on a diagonal: x - d is its column. `best` is scratch, one value per
/// column.
void pickRight(const float* cost, int width, SearchRange range, float* best, float* disparity) {
  std::fill(best, best + width, kNone);
  std::fill(disparity, disparity + width, kUnknown);
  for (int x = 0; x < width; ++x, cost += range.count) {
    const int begin = std::max(0, x - range.min - (width - 1)),
              end = std::min(range.count, x - range.min + 1);
    for (int i = begin; i < end; ++i) {
      const int column = x - range.min - i;
      // Ascending x meets ascending disparities: the smaller one of equal costs comes first.
      if (cost[i] < best[column]) {
        best[column] = cost[i];
        disparity[column] = static_cast<float>(range.min + i);
      }
    }
  }
}

}  // namespace

WindowMaps pickWinners(int width, int height, SearchRange range, WinnerPosition position, int threads,
                       FunctionRef<std::unique_ptr<CostRows>(int)> rowsFrom) {
  struct Strip {
    int begin, end;
    std::unique_ptr<CostRows> rows;
    Buffer<float> cost, best;
  };
  WindowMaps maps;
  maps.disparity.resize(width, height);
  maps.right_disparity.resize(width, height);
  maps.confidence.resize(width, height);
  maps.state.resize(width, height);

  std::vector<Strip> strips(static_cast<std::size_t>(std::clamp(threads, 1, height)));
  const int count = static_cast<int>(strips.size());
  for (int i = 0; i < count; ++i) {
    Strip& strip = strips[static_cast<std::size_t>(i)];
    strip.begin = static_cast<int>(static_cast<long long>(height) * i / count);
    strip.end = static_cast<int>(static_cast<long long>(height) * (i + 1) / count);
    strip.rows = rowsFrom(strip.begin);
    strip.cost.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(range.count));
    strip.best.resize(static_cast<std::size_t>(width));
  }
  parallelFor(threads, count, [&](int i) {
    Strip& strip = strips[static_cast<std::size_t>(i)];
    for (int y = strip.begin; y < strip.end; ++y) {
      strip.rows->next(strip.cost.data());
      pickLeft(strip.cost.data(), width, range, position, y, maps);
      pickRight(strip.cost.data(), width, range, strip.best.data(), maps.right_disparity.row(y));
    }
  });
  return maps;
}

}  // namespace pomona
