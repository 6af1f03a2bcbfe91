#include "pyramid/laplacian.h"

#include <algorithm>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 16;

void copyRows(ImageView<const float> in, ImageView<float> out, int threads) {
  parallelStrips(threads, in.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) std::copy_n(in.row(y), in.width, out.row(y));
  });
}

}  // namespace

void reduce(ImageView<const float> in, ImageView<float> out, Arena& scratch, const PyramidKernels& kernels,
            int threads) {
  const Arena::Scope scope(scratch);
  const auto narrowed = scratch.image<float>(out.width, in.height);
  parallelStrips(threads, in.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) kernels.reduceRow(in.row(y), in.width, narrowed.row(y));
  });
  parallelStrips(threads, out.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* rows[5];
      for (int k = 0; k < 5; ++k) rows[k] = narrowed.row(std::clamp(2 * y + k - 2, 0, in.height - 1));
      kernels.reduceColumn(rows, out.width, out.row(y));
    }
  });
}

void addExpanded(ImageView<const float> in, float gain, ImageView<float> inout, Arena& scratch,
                 const PyramidKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  const auto widened = scratch.image<float>(inout.width, in.height);
  parallelStrips(threads, in.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) kernels.expandRow(in.row(y), inout.width, widened.row(y));
  });
  parallelStrips(threads, inout.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const bool odd = y % 2 != 0;  // between two samples, whose weights are equal; else on one
      const float* middle = widened.row(y / 2);
      const float* above = odd ? middle : widened.row(std::max(0, y / 2 - 1));
      const float* below = widened.row(std::min(in.height - 1, y / 2 + 1));
      kernels.addExpandedColumn(above, middle, below, gain * (odd ? 0.5f : 0.125f),
                                gain * (odd ? 0.0f : 0.75f), inout.width, inout.row(y));
    }
  });
}

void GaussianPyramid::build(ImageView<const float> map, int levels, const PyramidKernels& kernels,
                            Arena& arena, int threads) {
  images_[0] = arena.image<float>(map.width, map.height);
  copyRows(map, level(0), threads);
  for (levels_ = 1; levels_ < std::min(levels, kMaxPyramidLevels); ++levels_) {
    const ImageView<float> finer = level(levels_ - 1);
    if (std::min(finer.width, finer.height) == 1) return;
    images_[static_cast<std::size_t>(levels_)] =
        arena.image<float>((finer.width + 1) / 2, (finer.height + 1) / 2);
    reduce(finer, level(levels_), arena, kernels, threads);
  }
}

void LaplacianPyramid::build(ImageView<const float> map, int levels, const PyramidKernels& kernels,
                             Arena& arena, int threads) {
  bands_.build(map, levels, kernels, arena, threads);
  for (int i = 0; i + 1 < bands_.levels(); ++i)
    addExpanded(level(i + 1), -1.0f, level(i), arena, kernels, threads);
}

void LaplacianPyramid::collapse(ImageView<float> out, const PyramidKernels& kernels, Arena& scratch,
                                int threads) {
  for (int i = bands_.levels() - 2; i >= 0; --i)
    addExpanded(level(i + 1), 1.0f, level(i), scratch, kernels, threads);
  copyRows(level(0), out, threads);
}

}  // namespace pomona
