#include "sgm/kernels.h"

#include "core/cpu.h"

namespace pomona {

extern const SgmKernels kSgmKernelsScalar, kSgmKernelsAvx2, kSgmKernelsAvx512, kSgmKernelsNeon;

const SgmKernels& sgmKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return kSgmKernelsAvx2;
#endif
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return kSgmKernelsAvx512;
#endif
#if defined(POMONA_WITH_NEON)
    case Isa::kNeon:
      return kSgmKernelsNeon;
#endif
    default:
      return kSgmKernelsScalar;
  }
}

}  // namespace pomona
