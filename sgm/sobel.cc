#include "sgm/sobel.h"

#include <algorithm>
#include <cstring>

#include "core/parallel.h"

namespace pomona {

ImageView<std::uint8_t> computeSobel(ImageView<const std::uint8_t> gray, const SgmKernels& kernels,
                                     Arena& arena, int threads) {
  const int width = gray.width, height = gray.height;
  const auto out = arena.image<std::uint8_t>(width, height);
  const Arena::Scope scope(arena);
  const auto padded = arena.image<std::uint8_t>(width + 2, height);
  parallelStrips(threads, height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint8_t* to = padded.row(y);
      to[0] = gray.row(y)[0];
      std::memcpy(to + 1, gray.row(y), static_cast<std::size_t>(width));
      to[width + 1] = gray.row(y)[width - 1];
    }
  });
  parallelStrips(threads, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* rows[3];
      for (int k = 0; k < 3; ++k) rows[k] = padded.row(std::clamp(y + k - 1, 0, height - 1)) + 1;
      kernels.sobel(rows, width, out.row(y));
    }
  });
  return out;
}

}  // namespace pomona
