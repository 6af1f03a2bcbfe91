#include "sgm/color_steps.h"

#include <algorithm>
#include <cstdlib>

namespace pomona {

/// From pixel (x + dx, y + dy), where dx is -1, 0 or 1.
void ColorSteps::stepsFrom(int y, int dx, int dy, std::uint8_t* out) const {
  const int width = image_.width, channels = image_.channels;
  if (y + dy < 0) {
    std::fill_n(out, width + 2, std::uint8_t{0});
    return;
  }
  const int first = std::max(0, -dx), count = width - std::abs(dx);  // the columns that have this neighbour
  out[0] = out[1] = out[width] = out[width + 1] = 0;
  kernels_.colorSteps(image_.row(y) + first * channels, image_.row(y + dy) + (first + dx) * channels,
                      channels, count, out + 1 + first);
}

void ColorSteps::left(int y, std::uint8_t* out) const {
  stepsFrom(y, -1, 0, out);
}
void ColorSteps::aboveLeft(int y, std::uint8_t* out) const {
  stepsFrom(y, -1, -1, out);
}
void ColorSteps::above(int y, std::uint8_t* out) const {
  stepsFrom(y, 0, -1, out);
}
void ColorSteps::aboveRight(int y, std::uint8_t* out) const {
  stepsFrom(y, 1, -1, out);
}

}  // namespace pomona
