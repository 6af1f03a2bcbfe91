#include "plugins/common/kernels.h"

#include "core/cpu.h"

namespace pomona {

const DistanceKernels& distanceKernelsScalar();
const DistanceKernels& distanceKernelsAvx2();
const DistanceKernels& distanceKernelsAvx512();

const DistanceKernels& distanceKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return distanceKernelsAvx512();
#endif
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return distanceKernelsAvx2();
#endif
    default:
      return distanceKernelsScalar();
  }
}

}  // namespace pomona
