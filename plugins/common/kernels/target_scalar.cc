#include "plugins/common/kernels/distances.inl"

namespace pomona {

const DistanceKernels& distanceKernelsScalar() {
  return kTable;
}

}  // namespace pomona
