// All kernels of this folder, in the byte vocabulary (core/simd/) that the including file has chosen.
#include "sgm/kernels.h"
#include "sgm/kernels/aggregate.inl"
#include "sgm/kernels/cost.inl"
#include "sgm/kernels/features.inl"
#include "sgm/kernels/refine.inl"

namespace pomona {
namespace {

constexpr SgmKernels kTable = {.vector_bytes = simd::kBytes,
                               .gray8 = grayRow<std::uint8_t>,
                               .gray16 = grayRow<std::uint16_t>,
                               .census8 = censusRow<std::uint8_t>,
                               .census16 = censusRow<std::uint16_t>,
                               .sobel = sobelRow,
                               .colorSteps = colorStepRows,
                               .dealRow = dealRow,
                               .censusCost = censusCost,
                               .tableCost = tableCost,
                               .blendedCost = blendedCost,
                               .support = support,
                               .prior = prior,
                               .aggregateFirst = aggregateFirst,
                               .score = scoreRow,
                               .refine = {refineRow<NoOffset>, refineRow<ParabolaOffset>,
                                          refineRow<EquiangularOffset>, refineRow<FittedOffset>},
                               .aggregateLast = aggregateLast};

}  // namespace
}  // namespace pomona
