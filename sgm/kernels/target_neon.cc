#include "core/simd/neon.h"
#include "sgm/kernels/table.inl"

namespace pomona {

extern const SgmKernels kSgmKernelsNeon;
const SgmKernels kSgmKernelsNeon = kTable;

}  // namespace pomona
