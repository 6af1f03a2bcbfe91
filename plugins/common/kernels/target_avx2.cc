#include "plugins/common/kernels/distances.inl"

namespace pomona {

const DistanceKernels& distanceKernelsAvx2() {
  return kTable;
}

}  // namespace pomona
