#include "filters/kernels.h"

#include "core/cpu.h"

namespace pomona {

const FilterKernels& filterKernelsScalar();
const FilterKernels& filterKernelsAvx2();
const FilterKernels& filterKernelsAvx512();

const FilterKernels& filterKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return filterKernelsAvx512();
#endif
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return filterKernelsAvx2();
#endif
    default:
      return filterKernelsScalar();
  }
}

}  // namespace pomona
