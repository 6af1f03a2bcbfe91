#include "baselines/kernels/asw.inl"

namespace pomona {

const AswKernels& aswKernelsAvx2() {
  return kTable;
}

}  // namespace pomona
