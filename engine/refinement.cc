#include "engine/refinement.h"

#include "filters/median.h"
#include "filters/plane_refine.h"
#include "filters/weighted_median.h"

namespace pomona {

void refine(ImageView<float> disparity, GuideView guide, const CompletionOptions& options,
            const FilterKernels& kernels, Arena& scratch, int threads, StageClock& clock) {
  if (options.weighted_median) {
    weightedMedian(disparity, guide, disparity, scratch, kernels, threads);
    clock.lap("weighted median");
  }
  if (options.median_size > 0) {
    medianFilter(disparity, disparity, options.median_size, kernels, scratch, threads);
    clock.lap("dense median");
  }
  if (options.plane_refinement) {
    refinePlanes(disparity, guide, options.refine_radius_px, disparity, scratch, kernels, threads);
    clock.lap("refinement");
  }
}

}  // namespace pomona
