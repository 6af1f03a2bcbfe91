#include "camera/kernels/table.inl"

namespace pomona {

const CameraKernels& cameraKernelsAvx2() {
  return kTable;
}

}  // namespace pomona
