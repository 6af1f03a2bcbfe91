#include "sgm/color_steps.h"

#include <algorithm>

#include "core/parallel.h"

namespace pomona {

void ColorSteps::compute(GuideView image, const SgmKernels& kernels, Arena& arena, int threads) {
  const int width = image.width, channels = image.channels;
  ImageView<std::uint8_t>* const maps[] = {&left_, &above_left_, &above_, &above_right_};
  for (ImageView<std::uint8_t>* map : maps) *map = arena.image<std::uint8_t>(width + 2, image.height);
  parallelStrips(threads, image.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (const ImageView<std::uint8_t>* map : maps)  // what no step is written to
        for (int x : {0, 1, width, width + 1}) map->row(y)[x] = 0;
      const std::uint8_t* here = image.row(y);
      kernels.colorSteps(here + channels, here, channels, width - 1, left_.row(y) + 2);
      if (y == 0) {
        for (const ImageView<std::uint8_t>* map : {&above_left_, &above_, &above_right_})
          std::fill_n(map->row(y), width + 2, std::uint8_t{0});
        continue;
      }
      const std::uint8_t* over = image.row(y - 1);
      kernels.colorSteps(here + channels, over, channels, width - 1, above_left_.row(y) + 2);
      kernels.colorSteps(here, over, channels, width, above_.row(y) + 1);
      kernels.colorSteps(here, over + channels, channels, width - 1, above_right_.row(y) + 1);
    }
  });
}

}  // namespace pomona
