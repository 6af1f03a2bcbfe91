#include "baselines/kernels/asw.inl"

namespace pomona {

const AswKernels& aswKernelsAvx512() {
  return kTable;
}

}  // namespace pomona
