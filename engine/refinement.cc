#include "engine/refinement.h"

namespace pomona {

void Refinement::run(Image<float>& disparity, GuideView guide, const CompletionOptions& options,
                     const FilterKernels& kernels, int threads, StageClock& clock) {
  if (options.weighted_median) {
    weightedMedian(disparity.view(), guide, disparity.view(), weighted_median_, kernels, threads);
    medianFilter(disparity.view(), disparity.view(), 5, kernels, median_, threads);
    clock.lap("weighted median");
  }
  if (options.plane_refinement) {
    refinePlanes(disparity.view(), guide, options.refine_radius_px, disparity.view(), weighted_median_.plane,
                 kernels, threads);
    clock.lap("refinement");
  }
}

}  // namespace pomona
