#include "engine/refinement.h"

#include <utility>

namespace pomona {

void Refinement::run(Image<float>& disparity, GuideView guide, const CompletionOptions& options,
                     const FilterKernels& kernels, int threads, StageClock& clock) {
  if (options.weighted_median) {
    weightedMedian(disparity.view(), guide, disparity.view(), weighted_median_, kernels, threads);
    filtered_.resize(disparity.width(), disparity.height());
    medianFilter(disparity.view(), filtered_.view(), 5, kernels, median_, threads);
    std::swap(disparity, filtered_);
    clock.lap("weighted median");
  }
  if (options.plane_refinement) {
    refinePlanes(disparity.view(), guide, options.refine_radius_px, disparity.view(), weighted_median_.plane,
                 kernels, threads);
    clock.lap("refinement");
  }
}

}  // namespace pomona
