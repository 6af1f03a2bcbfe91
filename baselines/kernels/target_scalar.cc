#include "baselines/kernels/asw.inl"

namespace pomona {

const AswKernels& aswKernelsScalar() {
  return kTable;
}

}  // namespace pomona
