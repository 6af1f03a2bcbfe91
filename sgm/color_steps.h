// How much the colour changes from a pixel to its neighbours: what steers penalties and supports.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "sgm/kernels.h"

namespace pomona {

/// Largest channel difference, 8-bit units, between (x, y) and one neighbour of the row above or to the left;
/// 0 where that lies outside the image. The other four neighbours see the same steps from their side.
class ColorSteps {
 public:
  /// They lie in the current scope of `arena`.
  void compute(GuideView image, const SgmKernels& kernels, Arena& arena, int threads);

  /// Rows are readable from -1 to width.
  const std::uint8_t* left(int y) const { return left_.row(y) + 1; }
  const std::uint8_t* aboveLeft(int y) const { return above_left_.row(y) + 1; }
  const std::uint8_t* above(int y) const { return above_.row(y) + 1; }
  const std::uint8_t* aboveRight(int y) const { return above_right_.row(y) + 1; }

 private:
  ImageView<std::uint8_t> left_, above_left_, above_, above_right_;
};

}  // namespace pomona
