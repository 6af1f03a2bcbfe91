// All kernels of this folder, compiled for the instruction set of the including file.
#include "core/simd/float.h"
#include "filters/kernels.h"
#include "filters/kernels/exp2.inl"
#include "filters/kernels/joint_bilateral.inl"
#include "filters/kernels/median.inl"

namespace pomona {
namespace {

constexpr FilterKernels kTable = {medianRow<3>, medianRow<5>, jointBilateralBlock};

}  // namespace
}  // namespace pomona
