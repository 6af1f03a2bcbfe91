#include "filters/kernels/table.inl"

namespace pomona {

const FilterKernels& filterKernelsAvx512() {
  return kTable;
}

}  // namespace pomona
