#include "pyramid/hole_rays.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "pyramid/holes.h"

namespace pomona {
namespace {

constexpr int kPadding = 2;   // a step of a ray spans at most two columns ...
constexpr int kRingRows = 3;  // ... and two rows
constexpr int kMinRowsPerStrip = 16;

bool endsRays(float disparity, std::uint8_t state) {
  return isSource(disparity, state) || static_cast<PixelState>(state) == PixelState::kFilledPlane;
}

void advanceAlongRow(int dx, const std::uint16_t* open, int width, std::uint16_t* out) {
  int steps = HoleRays::kNoSource;
  for (int i = 0; i < width; ++i) {
    const int x = dx < 0 ? i : width - 1 - i;
    steps = (std::min(steps, HoleRays::kNoSource - 1) + 1) & open[x];
    out[x] = static_cast<std::uint16_t>(steps);
  }
}

}  // namespace

void HoleRays::findHoles(ImageView<const float> disparity, ImageView<const std::uint8_t> state, Arena& arena,
                         int threads) {
  const int width = disparity.width, height = disparity.height;
  row_begin_ = arena.take<int>(static_cast<std::size_t>(height) + 1);
  open_ = arena.image<std::uint16_t>(width, height);
  ring_rows_ = arena.image<std::uint16_t>(width + 2 * kPadding, kRingRows * static_cast<int>(kRays.size()));
  // As many as there can be: the number of holes changes from frame to frame, the memory must not.
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  holes_ = arena.take<Pixel>(pixels);
  steps_ = arena.take<std::uint16_t>(kRays.size() * pixels);
  int* const row_begin = row_begin_;
  parallelStrips(threads, height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* d = disparity.row(y);
      const std::uint8_t* s = state.row(y);
      std::uint16_t* open = open_.row(y);
      int holes = 0;
      for (int x = 0; x < width; ++x) {
        open[x] = endsRays(d[x], s[x]) ? 0 : kNoSource;
        holes += isHole(d[x], s[x]);
      }
      row_begin[y + 1] = holes;
    }
  });
  row_begin[0] = 0;
  for (int y = 0; y < height; ++y) row_begin[y + 1] += row_begin[y];
  count_ = row_begin[height];
  parallelStrips(threads, height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Pixel* next = holes_ + row_begin[y];
      if (row_begin[y] == row_begin[y + 1]) continue;
      for (int x = 0; x < width; ++x)
        if (isHole(disparity.at(y, x), state.at(y, x)))
          *next++ = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
    }
  });
}

void HoleRays::follow(int radius_px, const PyramidKernels& kernels, int threads) {
  parallelFor(threads, static_cast<int>(kRays.size()),
              [&](int ray) { followRay(static_cast<std::size_t>(ray), radius_px, kernels); });
}

// Row by row, in the order that has the next pixel of each ray done before the pixel itself.
void HoleRays::followRay(std::size_t index, int radius_px, const PyramidKernels& kernels) {
  const Ray ray = kRays[index];
  const int width = open_.width, height = open_.height;
  const double longest = std::sqrt(static_cast<double>(radius_px) * radius_px / ray.squaredStep());
  const int max_steps = static_cast<int>(std::min(longest, kNoSource - 1.0));
  std::uint16_t* steps = steps_ + index * static_cast<std::size_t>(count_);
  const auto ring = [&](int i) {
    return ring_rows_.row(static_cast<int>(index) * kRingRows + i % kRingRows) + kPadding;
  };
  for (int i = 0; i < kRingRows; ++i) std::fill_n(ring(i) - kPadding, width + 2 * kPadding, kNoSource);
  for (int i = 0; i < height; ++i) {
    const int y = ray.dy > 0 ? height - 1 - i : i;
    std::uint16_t* row = ring(i);
    if (ray.dy == 0)
      advanceAlongRow(ray.dx, open_.row(y), width, row);
    else
      kernels.advanceRays(ring(i + kRingRows - std::abs(ray.dy)) + ray.dx, open_.row(y), width, row);
    for (int h = row_begin_[y]; h < row_begin_[y + 1]; ++h) {
      const std::uint16_t s = row[holes_[h].x];
      steps[h] = s <= max_steps ? s : kNoSource;
    }
  }
}

}  // namespace pomona
