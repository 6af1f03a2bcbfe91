#include "sgm/color_steps.h"

#include <algorithm>

#include "core/parallel.h"

namespace pomona {

void ColorSteps::compute(GuideView image, const SgmKernels& kernels, int threads) {
  const int width = image.width, channels = image.channels;
  for (Image<std::uint8_t>* map : {&left, &above_left, &above, &above_right})
    map->resize(width, image.height);
  parallelStrips(threads, image.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* here = image.row(y);
      left.row(y)[0] = above_left.row(y)[0] = above_right.row(y)[width - 1] = 0;
      kernels.colorSteps(here + channels, here, channels, width - 1, left.row(y) + 1);
      if (y == 0) {
        for (Image<std::uint8_t>* map : {&above_left, &above, &above_right})
          std::fill_n(map->row(y), width, 0);
        continue;
      }
      const std::uint8_t* over = image.row(y - 1);
      kernels.colorSteps(here + channels, over, channels, width - 1, above_left.row(y) + 1);
      kernels.colorSteps(here, over, channels, width, above.row(y));
      kernels.colorSteps(here, over + channels, channels, width - 1, above_right.row(y));
    }
  });
}

}  // namespace pomona
