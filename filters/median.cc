#include "filters/median.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "filters/padded_plane.h"

namespace pomona {

void medianFilter(ImageView<const float> in, ImageView<float> out, int size, const FilterKernels& kernels,
                  Arena& scratch, int threads) {
  if (size != 3 && size != 5)
    throw std::invalid_argument("median size is " + std::to_string(size) + "; allowed: 3, 5");
  if (in.empty()) return;

  const int radius = size / 2;
  const Arena::Scope scope(scratch);
  const PaddedPlane padded(scratch, in.width, in.height, radius, std::numeric_limits<float>::quiet_NaN());
  parallelStrips(threads, in.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) std::copy_n(in.row(y), in.width, padded.row(y));
  });

  const auto median_row = size == 3 ? kernels.median3x3 : kernels.median5x5;
  parallelStrips(threads, in.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* rows[5];
      for (int i = 0; i < size; ++i) rows[i] = padded.row(y + i - radius);
      median_row(rows, in.width, out.row(y));
    }
  });
}

}  // namespace pomona
