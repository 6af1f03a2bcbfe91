#include "pyramid/hole_rays.h"

#include <algorithm>

#include "core/parallel.h"
#include "pyramid/hole_states.h"

namespace pomona {
namespace {

constexpr std::size_t kRowRays = 2;  // kRays[0] and [1]
constexpr int kMinRowsPerStrip = 16;

}  // namespace

void HoleRays::findHoles(ImageView<const float> disparity, ImageView<const std::uint8_t> state, Arena& arena,
                         const PyramidKernels& kernels, int threads) {
  const int width = disparity.width, height = disparity.height;
  row_begin_ = arena.take<int>(static_cast<std::size_t>(height) + 1);
  open_ = arena.image<std::uint16_t>(width, height);
  distances_ = arena.image<std::uint16_t>(width, kHoleRays);
  // As many as there can be: the number of holes changes from frame to frame, the memory must not.
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  steps_ = arena.take<std::uint16_t>(kRays.size() * pixels);
  holes_ = arena.take<Pixel>(pixels);
  const auto is_hole = arena.image<std::uint8_t>(width, height);
  parallelStrips(threads, height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      row_begin_[y + 1] =
          kernels.findHoles(disparity.row(y), state.row(y), kHoleStates, width, open_.row(y), is_hole.row(y));
  });
  row_begin_[0] = 0;
  for (int y = 0; y < height; ++y) row_begin_[y + 1] += row_begin_[y];
  count_ = row_begin_[height];
  parallelStrips(threads, height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Pixel* next = holes_ + row_begin_[y];
      const std::uint8_t *row = is_hole.row(y), *row_end = row + width;
      for (const std::uint8_t* p = row; next < holes_ + row_begin_[y + 1]; ++p) {
        p = std::find(p, row_end, std::uint8_t{1});
        *next++ = {static_cast<std::uint16_t>(p - row), static_cast<std::uint16_t>(y)};
      }
    }
  });
}

void HoleRays::follow(int radius_px, const PyramidKernels& kernels, int threads) {
  parallelStrips(threads, open_.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (std::size_t ray = 0; ray < kRowRays; ++ray) followRow(ray, y, radius_px);
  });
  parallelFor(threads, kHoleRays - static_cast<int>(kRowRays),
              [&](int ray) { followColumns(kRowRays + static_cast<std::size_t>(ray), radius_px, kernels); });
}

// Each hole looks no farther than to the one before it.
void HoleRays::followRow(std::size_t ray, int y, int radius_px) {
  const std::uint16_t* open = open_.row(y);
  std::uint16_t* steps = steps_ + ray * static_cast<std::size_t>(count_);
  const int dx = kRays[ray].dx, outside = dx < 0 ? -1 : open_.width;
  const int holes = row_begin_[y + 1] - row_begin_[y];
  int before = outside, source = outside;  // the hole before, and the source that its ray meets
  for (int i = 0; i < holes; ++i) {
    const int hole = dx < 0 ? row_begin_[y] + i : row_begin_[y + 1] - 1 - i;
    int x = holes_[hole].x + dx;
    while (x != before && open[x] != 0) x += dx;
    if (x != before) source = x;
    before = holes_[hole].x;
    const int length = std::abs(source - before);
    steps[hole] = source != outside && length <= radius_px ? static_cast<std::uint16_t>(length) : kNoSource;
  }
}

// Row by row, in the order that has the next pixel of each ray done before the pixel itself.
void HoleRays::followColumns(std::size_t ray, int radius_px, const PyramidKernels& kernels) {
  const int width = open_.width, height = open_.height;
  const int most = std::min(radius_px, kNoSource - 1);
  std::uint16_t* const steps = steps_ + ray * static_cast<std::size_t>(count_);
  std::uint16_t* const distance = distances_.row(static_cast<int>(ray));
  std::fill_n(distance, width, kNoSource);
  for (int i = 0; i < height; ++i) {
    const int y = kRays[ray].dy > 0 ? height - 1 - i : i;
    kernels.advanceRays(open_.row(y), width, distance);
    for (int hole = row_begin_[y]; hole < row_begin_[y + 1]; ++hole) {
      const std::uint16_t s = distance[holes_[hole].x];
      steps[hole] = s <= most ? s : kNoSource;
    }
  }
}

}  // namespace pomona
