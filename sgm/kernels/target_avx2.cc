#include "core/simd/avx2.h"
#include "sgm/kernels/aggregate.inl"
#include "sgm/kernels/cost.inl"
#include "sgm/kernels/features.inl"

namespace pomona {
extern const SgmKernels kSgmKernelsAvx2;
const SgmKernels kSgmKernelsAvx2 = {simd::kBytes,
                                    censusRow<std::uint8_t>,
                                    censusRow<std::uint16_t>,
                                    sobelRow,
                                    colorStepRow,
                                    censusCost,
                                    tableCost,
                                    blendedCost,
                                    support,
                                    aggregateFirst,
                                    aggregateLast};
}  // namespace pomona
