#include "baselines/kernels.h"

#include "core/cpu.h"

namespace pomona {

const AswKernels& aswKernelsScalar();
const AswKernels& aswKernelsAvx2();
const AswKernels& aswKernelsAvx512();

const AswKernels& aswKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return aswKernelsAvx512();
#endif
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return aswKernelsAvx2();
#endif
    default:
      return aswKernelsScalar();
  }
}

}  // namespace pomona
