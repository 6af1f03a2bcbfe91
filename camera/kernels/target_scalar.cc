#include "camera/kernels/table.inl"

namespace pomona {

const CameraKernels& cameraKernelsScalar() {
  return kTable;
}

}  // namespace pomona
