#include "pyramid/fusion.h"

#include "core/parallel.h"
#include "pyramid/laplacian.h"

namespace pomona {

void fuseEqual(ImageView<const float> a, ImageView<const float> b, int levels, ImageView<float> out,
               Arena& scratch, const PyramidKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  LaplacianPyramid bands, others;
  bands.build(a, levels, kernels, scratch, threads);
  others.build(b, levels, kernels, scratch, threads);
  for (int i = 0; i < bands.levels(); ++i) {
    const ImageView<float> band_a = bands.level(i), band_b = others.level(i);
    parallelStrips(threads, band_a.height, 16, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) kernels.average(band_b.row(y), band_a.width, band_a.row(y));
    });
  }
  bands.collapse(out, kernels, scratch, threads);
}

}  // namespace pomona
