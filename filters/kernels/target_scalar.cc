#include "filters/kernels/table.inl"

namespace pomona {

const FilterKernels& filterKernelsScalar() {
  return kTable;
}

}  // namespace pomona
