#include "core/simd/avx512.h"
#include "sgm/kernels/aggregate.inl"
#include "sgm/kernels/cost.inl"
#include "sgm/kernels/features.inl"

namespace pomona {
extern const SgmKernels kSgmKernelsAvx512;
const SgmKernels kSgmKernelsAvx512 = {simd::kBytes,
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
