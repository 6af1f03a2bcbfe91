// What a dense map goes through after its holes are filled.
#pragma once

#include "core/arena.h"
#include "core/image.h"
#include "engine/stage_clock.h"
#include "filters/kernels.h"
#include "pomona/options.h"

namespace pomona {

/// Moves jumps to the edges of the guide, then smooths within surfaces, as far as `options` ask for it. NaN
/// stays NaN, and nothing else becomes it.
void refine(ImageView<float> disparity, GuideView guide, const CompletionOptions& options,
            const FilterKernels& kernels, Arena& scratch, int threads, StageClock& clock);

}  // namespace pomona
