#include "pyramid/view_border.h"

#include <cmath>

#include "core/parallel.h"
#include "pyramid/holes.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 32;

bool isAtColumn(int column, int x, float disparity) {
  return std::abs(static_cast<float>(x) - disparity - static_cast<float>(column)) < 1;
}

}  // namespace

void ViewBorder::find(ImageView<const float> disparity, ImageView<const std::uint8_t> state, Arena& arena,
                      int threads) {
  const int width = disparity.width, last = width - 1;
  ends_ = arena.take<Ends>(static_cast<std::size_t>(disparity.height));
  parallelStrips(threads, disparity.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* d = disparity.row(y);
      const std::uint8_t* s = state.row(y);
      int left = 0, right = last;
      while (left < width && !isSource(d[left], s[left])) ++left;
      while (right > left && !isSource(d[right], s[right])) --right;
      Ends& ends = ends_[y];
      ends = {{-1, 0}, {width, 0}};
      if (left == width) continue;
      if (isAtColumn(0, left, d[left])) ends.left = {left, d[left]};
      if (isAtColumn(last, right, d[right])) ends.right = {right, d[right]};
    }
  });
}

}  // namespace pomona
