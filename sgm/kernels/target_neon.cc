#include "core/simd/neon.h"
#include "sgm/kernels/aggregate.inl"
#include "sgm/kernels/cost.inl"
#include "sgm/kernels/features.inl"
#include "sgm/kernels/refine.inl"

namespace pomona {
extern const SgmKernels kSgmKernelsNeon;
const SgmKernels kSgmKernelsNeon = {.vector_bytes = simd::kBytes,
                                      .census8 = censusRow<std::uint8_t>,
                                      .census16 = censusRow<std::uint16_t>,
                                      .sobel = sobelRow,
                                      .colorSteps = colorStepRow,
                                      .censusCost = censusCost,
                                      .tableCost = tableCost,
                                      .blendedCost = blendedCost,
                                      .support = support,
                                      .prior = prior,
                                      .aggregateFirst = aggregateFirst,
                                      .refine = {refineRow<NoOffset>, refineRow<ParabolaOffset>,
                                                 refineRow<EquiangularOffset>, refineRow<FittedOffset>},
                                      .aggregateLast = aggregateLast};
}  // namespace pomona
