// Winner-take-all over matching costs that arrive row by row.
#pragma once

#include <cstdint>
#include <memory>

#include "core/image.h"
#include "core/parallel.h"

namespace pomona {

struct SearchRange {
  int min = 0;
  int count = 64;
};

/// The matching costs of consecutive rows.
class CostRows {
 public:
  virtual ~CostRows() = default;
  /// Writes the costs of the next row: cost[x * count + i] for the disparity min + i, smaller is better, and
  /// +infinity where x - (min + i) lies outside the right view. Must not throw.
  virtual void next(float* cost) = 0;
};

/// Maps of the left image's size.
struct WindowMaps {
  Image<float> disparity;        ///< pixels; NaN where no match lies in view
  Image<float> right_disparity;  ///< of the right view, whole pixels, d = x_left - x_right; NaN as above
  Image<float> confidence;       ///< 1 - best / second best cost, at least two pixels apart; 0 where unknown
  Image<std::uint8_t> state;     ///< PixelState: measured or out of range
};

/// How disparities are picked.
enum class WinnerPosition {
  kWhole,     ///< whole pixels
  kParabola,  ///< the vertex of the parabola through the winner's cost and its neighbours'
};

/// Of equal costs the smaller disparity wins. Rows are cut into one strip per thread; `rowsFrom(y)` makes the
/// costs of rows y, y + 1, ...
WindowMaps pickWinners(int width, int height, SearchRange range, WinnerPosition position, int threads,
                       FunctionRef<std::unique_ptr<CostRows>(int)> rowsFrom);

}  // namespace pomona
