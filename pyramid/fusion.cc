#include "pyramid/fusion.h"

#include "core/parallel.h"

namespace pomona {

void fuseEqual(ImageView<const float> a, ImageView<const float> b, int levels, ImageView<float> out,
               FusionScratch& scratch, const PyramidKernels& kernels, int threads) {
  scratch.a.build(a, levels, kernels, threads);
  scratch.b.build(b, levels, kernels, threads);
  for (int i = 0; i < scratch.a.levels(); ++i) {
    const ImageView<float> band_a = scratch.a.level(i), band_b = scratch.b.level(i);
    parallelStrips(threads, band_a.height, 16, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) kernels.average(band_b.row(y), band_a.width, band_a.row(y));
    });
  }
  scratch.a.collapse(out, kernels, threads);
}

}  // namespace pomona
