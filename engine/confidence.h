// How much a disparity is worth.
#pragma once

#include "core/image.h"
#include "pomona/options.h"
#include "sgm/matcher.h"

namespace pomona {

/// Confidence in [0, 1] for every pixel of `maps`. Measured: (1 + m) / (1 + m + P2 / 4), with m the margin
/// between the best and the second-best sum, per path. Filled: a constant per source, 0.35 at most. Unknown:
/// 0.
void estimateConfidence(const MatchMaps& maps, const AggregationOptions& aggregation,
                        Image<float>& confidence, int threads);

}  // namespace pomona
