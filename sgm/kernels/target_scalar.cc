#include "core/simd/scalar.h"
#include "sgm/kernels/table.inl"

namespace pomona {

extern const SgmKernels kSgmKernelsScalar;
const SgmKernels kSgmKernelsScalar = kTable;

}  // namespace pomona
