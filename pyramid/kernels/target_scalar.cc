#include "pyramid/kernels/table.inl"

namespace pomona {

extern const PyramidKernels kPyramidKernelsScalar;
const PyramidKernels kPyramidKernelsScalar = kTable;

}  // namespace pomona
