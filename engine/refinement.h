// What a dense map goes through after its holes are filled.
#pragma once

#include "core/image.h"
#include "engine/stage_clock.h"
#include "filters/kernels.h"
#include "filters/median.h"
#include "filters/plane_refine.h"
#include "filters/weighted_median.h"
#include "pomona/options.h"

namespace pomona {

class Refinement {
 public:
  /// Moves jumps to the edges of the guide, then smooths within surfaces, as far as `options` ask for it.
  /// NaN stays NaN, and nothing else becomes it.
  void run(Image<float>& disparity, GuideView guide, const CompletionOptions& options,
           const FilterKernels& kernels, int threads, StageClock& clock);

 private:
  WeightedMedianScratch weighted_median_;
  MedianScratch median_;
};

}  // namespace pomona
