#include "pyramid/fusion.h"

#include "core/parallel.h"

namespace pomona {
namespace {

// combine(level, y, row of a's band, row of b's band, width) leaves the fused row in a's.
template <typename Combine>
void fuse(int levels, ImageView<const float> a, ImageView<const float> b, ImageView<float> out,
          FusionScratch& scratch, const PyramidKernels& kernels, int threads, Combine combine) {
  scratch.a.build(a, levels, kernels, threads);
  scratch.b.build(b, levels, kernels, threads);
  for (int i = 0; i < scratch.a.levels(); ++i) {
    const ImageView<float> band_a = scratch.a.level(i), band_b = scratch.b.level(i);
    parallelStrips(threads, band_a.height, 16, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) combine(i, y, band_a.row(y), band_b.row(y), band_a.width);
    });
  }
  scratch.a.collapse(out, kernels, threads);
}

}  // namespace

void fuseEqual(ImageView<const float> a, ImageView<const float> b, int levels, ImageView<float> out,
               FusionScratch& scratch, const PyramidKernels& kernels, int threads) {
  fuse(levels, a, b, out, scratch, kernels, threads,
       [&](int, int, float* row_a, const float* row_b, int n) { kernels.average(row_b, n, row_a); });
}

void fuseWeighted(ImageView<const float> a, ImageView<const float> b, ImageView<const float> weight_a,
                  int levels, ImageView<float> out, FusionScratch& scratch, const PyramidKernels& kernels,
                  int threads) {
  scratch.weight.build(weight_a, levels, kernels, threads);
  fuse(levels, a, b, out, scratch, kernels, threads,
       [&](int i, int y, float* row_a, const float* row_b, int n) {
         kernels.blend(row_b, scratch.weight.level(i).row(y), n, row_a);
       });
}

}  // namespace pomona
