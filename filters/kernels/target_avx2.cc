#include "filters/kernels/table.inl"

namespace pomona {

const FilterKernels& filterKernelsAvx2() {
  return kTable;
}

}  // namespace pomona
