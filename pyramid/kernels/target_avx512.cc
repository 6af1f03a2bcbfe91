#include "pyramid/kernels/table.inl"

namespace pomona {

extern const PyramidKernels kPyramidKernelsAvx512;
const PyramidKernels kPyramidKernelsAvx512 = kTable;

}  // namespace pomona
