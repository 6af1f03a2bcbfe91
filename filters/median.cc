#include "filters/median.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "core/prefetch.h"

namespace pomona {
namespace {

constexpr int kStripRows = 32, kMostRadius = 2;

/// The rows of an image around the current one of a strip [begin, end), with unknown pixels around the image:
/// near at hand, and out of the way of what is written in their place.
struct RowRing {
  ImageView<const float> in;
  ImageView<float> buffer;
  int first, count;  ///< its rows in `buffer`; behind them those after the strip's end
  int end;

  float* row(int y) const {
    return buffer.row(first + (y < end ? (y + count) % count : count + y - end)) + kMostRadius;
  }
  void read(int y) const {
    const bool inside = y >= 0 && y < in.height;
    const int width = inside ? in.width : 0;
    float *begin = row(y) - kMostRadius, *row_end = begin + buffer.width;
    std::fill(begin, row(y), std::numeric_limits<float>::quiet_NaN());
    if (inside) std::copy_n(in.row(y), width, row(y));
    std::fill(row(y) + width, row_end, std::numeric_limits<float>::quiet_NaN());
  }
};

}  // namespace

void medianFilter(ImageView<const float> in, ImageView<float> out, int size, const FilterKernels& kernels,
                  Arena& scratch, int threads) {
  if (size != 3 && size != 5)
    throw std::invalid_argument("median size is " + std::to_string(size) + "; allowed: 3, 5");
  if (in.empty()) return;

  const int strips = (in.height + kStripRows - 1) / kStripRows, radius = size / 2, kept = size + radius;
  const Arena::Scope scope(scratch);
  // Of each strip, those around the current one and after its end.
  const auto buffer = scratch.image<float>(in.width + kMostRadius + kMedianOverrun, strips * kept);
  const auto ringOf = [&](int strip) {
    return RowRing{in, buffer, strip * kept, size, std::min(in.height, (strip + 1) * kStripRows)};
  };
  parallelFor(threads, strips, [&](int strip) {  // what other strips may write
    const RowRing ring = ringOf(strip);
    for (int y = -radius; y < radius; ++y) ring.read(strip * kStripRows + y);
    for (int y = 0; y < radius; ++y) ring.read(ring.end + y);
  });
  const auto median_row = size == 3 ? kernels.median3x3 : kernels.median5x5;
  parallelFor(threads, strips, [&](int strip) {
    const RowRing ring = ringOf(strip);
    for (int y = strip * kStripRows; y < ring.end; ++y) {
      if (y + radius < ring.end) ring.read(y + radius);
      prefetchRow(in, y + radius + 1);
      const float* rows[2 * kMostRadius + 1];
      for (int i = 0; i < size; ++i) rows[i] = ring.row(y + i - radius);
      median_row(rows, in.width, out.row(y));
    }
  });
}

}  // namespace pomona
