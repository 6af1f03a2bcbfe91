#include "camera/kernels/table.inl"

namespace pomona {

const CameraKernels& cameraKernelsAvx512() {
  return kTable;
}

}  // namespace pomona
