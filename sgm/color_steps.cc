#include "sgm/color_steps.h"

#include <algorithm>

namespace pomona {

void ColorSteps::between(int seam, int y, const Rows& out) const {
  const int width = image_.width;
  const bool first = seam == 0;  // nothing is above
  kernels_.colorSteps(
      {.row_above = image_.row(first ? 0 : seam - 1),
       .row = image_.row(seam),
       .ahead = image_.row(y < seam ? std::max(0, y - 1) : std::min(y + 1, image_.height - 1)),
       .channels = image_.channels,
       .width = width,
       .left_of_above = y < seam,
       .left = out.left + 1,
       .above = out.above + 1,
       .above_left = out.above_left ? out.above_left + 1 : nullptr,
       .above_right = out.above_right ? out.above_right + 1 : nullptr});
  for (std::uint8_t* steps : {out.left, out.above, out.above_left, out.above_right}) {
    if (!steps) continue;
    if (first && steps != out.left) std::fill_n(steps, width + 2, std::uint8_t{0});
    steps[0] = steps[width + 1] = 0;
  }
  out.left[1] = 0;
  if (out.above_left) out.above_left[1] = out.above_right[width] = 0;
}

}  // namespace pomona
