#include "pyramid/kernels/table.inl"

namespace pomona {

extern const PyramidKernels kPyramidKernelsAvx2;
const PyramidKernels kPyramidKernelsAvx2 = kTable;

}  // namespace pomona
