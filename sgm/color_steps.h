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

  /// Write the steps into row y for the columns -1 to width: out[0] is column -1.
  void left(int y, std::uint8_t* out) const;
  void aboveLeft(int y, std::uint8_t* out) const;
  void above(int y, std::uint8_t* out) const;
  void aboveRight(int y, std::uint8_t* out) const;

 private:
  void stepsFrom(int y, int dx, int dy, std::uint8_t* out) const;

  GuideView image_;
  const SgmKernels& kernels_;
};

}  // namespace pomona
