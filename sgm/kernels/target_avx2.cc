#include "core/simd/avx2.h"
#include "sgm/kernels/table.inl"

namespace pomona {

extern const SgmKernels kSgmKernelsAvx2;
const SgmKernels kSgmKernelsAvx2 = kTable;

}  // namespace pomona
