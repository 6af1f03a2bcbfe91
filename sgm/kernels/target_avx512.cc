#include "core/simd/avx512.h"
#include "sgm/kernels/aggregate.inl"
#include "sgm/kernels/census.inl"
#include "sgm/kernels/cost.inl"

namespace pomona {
extern const SgmKernels kSgmKernelsAvx512;
const SgmKernels kSgmKernelsAvx512 = {
    simd::kBytes, censusRow<std::uint8_t>, censusRow<std::uint16_t>, censusCost, tableCost, aggregateFirst,
    aggregateLast};
}  // namespace pomona
