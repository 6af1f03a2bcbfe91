#include "plugins/common/surf/integral_image.h"

#include <algorithm>

namespace pomona {

IntegralImage::IntegralImage(ImageView<const std::uint8_t> gray) : sums_(gray.width + 1, gray.height + 1) {
  std::fill_n(sums_.row(0), gray.width + 1, 0u);
  for (int y = 0; y < gray.height; ++y) {
    const std::uint8_t* in = gray.row(y);
    const std::uint32_t* above = sums_.row(y);
    std::uint32_t* out = sums_.row(y + 1);
    std::uint32_t sum = out[0] = 0;
    for (int x = 0; x < gray.width; ++x) {
      sum += in[x];
      out[x + 1] = above[x + 1] + sum;
    }
  }
}

}  // namespace pomona
