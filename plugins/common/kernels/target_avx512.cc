#include "plugins/common/kernels/distances.inl"

namespace pomona {

const DistanceKernels& distanceKernelsAvx512() {
  return kTable;
}

}  // namespace pomona
