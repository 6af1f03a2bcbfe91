#include "camera/kernels.h"

#include "core/cpu.h"

namespace pomona {

const CameraKernels& cameraKernelsScalar();
const CameraKernels& cameraKernelsAvx2();
const CameraKernels& cameraKernelsAvx512();

const CameraKernels& cameraKernels(Isa isa) {
  switch (isa) {
#if defined(POMONA_WITH_AVX512)
    case Isa::kAvx512:
      return cameraKernelsAvx512();
#endif
#if defined(POMONA_WITH_AVX2)
    case Isa::kAvx2:
      return cameraKernelsAvx2();
#endif
    default:
      return cameraKernelsScalar();
  }
}

}  // namespace pomona
