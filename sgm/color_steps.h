// How much the colour changes from a pixel to its neighbours: what steers penalties and supports.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sgm/kernels.h"

namespace pomona {

/// Largest channel difference, 8-bit units, between (x, y) and one neighbour of the row above or to the left;
/// 0 where that lies outside the image. The other four neighbours see the same steps from their side. Rows
/// are computed where they are needed: it takes less time than a stored map would take memory.
class ColorSteps {
 public:
  ColorSteps(GuideView image, const SgmKernels& kernels) : image_(image), kernels_(kernels) {}

  /// For the columns -1 to width: element 0 is column -1.
  struct Rows {
    std::uint8_t *left, *above;
    std::uint8_t *above_left = nullptr, *above_right = nullptr;  ///< both or none
  };
  /// The steps up from row `seam`, and those to the left in row y, which is `seam` or the row above.
  void between(int seam, int y, const Rows& out) const;

 private:
  GuideView image_;
  const SgmKernels& kernels_;
};

}  // namespace pomona
