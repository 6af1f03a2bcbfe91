#include "filters/plane_refine.h"

#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "filters/guided_plane.h"

namespace pomona {

void refinePlanes(ImageView<const float> in, GuideView guide, int radius, ImageView<float> out,
                  Arena& scratch, const FilterKernels& kernels, int threads) {
  if (radius != 2 && radius != 3)
    throw std::invalid_argument("plane refinement radius is " + std::to_string(radius) + "; allowed: 2, 3");
  const Arena::Scope scope(scratch);
  const GuidedPlane plane(in, guide, radius, scratch, threads);
  const auto refine_row = kernels.refinePlanes[radius - 2];
  parallelStrips(threads, in.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) refine_row(plane.row(y), in.width, out.row(y));
  });
}

}  // namespace pomona
