#include "filters/median.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kStripRows = 32, kMostRadius = 2;

/// The last rows of an image that were read, with unknown pixels around it: near at hand, unlike a copy of
/// the whole.
struct RowRing {
  ImageView<const float> in;
  Image<float>& buffer;
  int first, count;  ///< its rows in `buffer`

  float* row(int y) const { return buffer.row(first + (y + count) % count) + kMostRadius; }
  void read(int y) const {
    const bool inside = y >= 0 && y < in.height;
    const int width = inside ? in.width : 0;
    float *begin = row(y) - kMostRadius, *end = begin + buffer.width();
    std::fill(begin, row(y), std::numeric_limits<float>::quiet_NaN());
    if (inside) std::copy_n(in.row(y), width, row(y));
    std::fill(row(y) + width, end, std::numeric_limits<float>::quiet_NaN());
  }
};

}  // namespace

void medianFilter(ImageView<const float> in, ImageView<float> out, int size, const FilterKernels& kernels,
                  MedianScratch& scratch, int threads) {
  if (size != 3 && size != 5)
    throw std::invalid_argument("median size is " + std::to_string(size) + "; allowed: 3, 5");
  if (in.empty()) return;

  const int strips = (in.height + kStripRows - 1) / kStripRows;
  scratch.rows.resize(in.width + kMostRadius + kMedianOverrun, strips * size);
  parallelFor(threads, strips, [&](int strip) {
    RowRing ring{in, scratch.rows, strip * size, size};
    const int radius = size / 2, begin = strip * kStripRows, end = std::min(in.height, begin + kStripRows);
    for (int y = begin - radius; y < begin + radius; ++y) ring.read(y);
    for (int y = begin; y < end; ++y) {
      ring.read(y + radius);
      const float* rows[5];
      for (int i = 0; i < size; ++i) rows[i] = ring.row(y + i - radius);
      (size == 3 ? kernels.median3x3 : kernels.median5x5)(rows, in.width, out.row(y));
    }
  });
}

}  // namespace pomona
