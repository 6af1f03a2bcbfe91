#include "pyramid/kernels.h"

#include "core/cpu.h"

namespace pomona {

extern const PyramidKernels kPyramidKernelsScalar;
extern const PyramidKernels kPyramidKernelsAvx2;
extern const PyramidKernels kPyramidKernelsAvx512;

const PyramidKernels& pyramidKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return kPyramidKernelsAvx512;
#endif
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return kPyramidKernelsAvx2;
#endif
    default:
      return kPyramidKernelsScalar;
  }
}

}  // namespace pomona
