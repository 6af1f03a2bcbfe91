#include "core/simd/avx512.h"
#include "sgm/kernels/table.inl"

namespace pomona {

extern const SgmKernels kSgmKernelsAvx512;
const SgmKernels kSgmKernelsAvx512 = kTable;

}  // namespace pomona
