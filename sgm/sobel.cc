#include "sgm/sobel.h"

#include <algorithm>
#include <cstring>

#include "core/parallel.h"

namespace pomona {

void SobelFilter::compute(ImageView<const std::uint8_t> gray, Image<std::uint8_t>& out,
                          const SgmKernels& kernels, int threads) {
  const int width = gray.width, height = gray.height;
  out.resize(width, height);
  padded_.resize(width + 2, height);
  parallelStrips(threads, height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint8_t* to = padded_.row(y);
      to[0] = gray.row(y)[0];
      std::memcpy(to + 1, gray.row(y), static_cast<std::size_t>(width));
      to[width + 1] = gray.row(y)[width - 1];
    }
  });
  parallelStrips(threads, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* rows[3];
      for (int k = 0; k < 3; ++k) rows[k] = padded_.row(std::clamp(y + k - 1, 0, height - 1)) + 1;
      kernels.sobel(rows, width, out.row(y));
    }
  });
}

}  // namespace pomona
