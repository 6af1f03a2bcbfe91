// All kernels of this folder, compiled for the instruction set of the including file.
#include "core/simd/float.h"
#include "filters/kernels.h"
#include "filters/kernels/color.inl"
#include "filters/kernels/exp2.inl"
#include "filters/kernels/joint_bilateral.inl"
#include "filters/kernels/left_right.inl"
#include "filters/kernels/median.inl"
#include "filters/kernels/plane_refine.inl"
#include "filters/kernels/speckle.inl"
#include "filters/kernels/trust.inl"
#include "filters/kernels/weighted_median.inl"

namespace pomona {
namespace {

constexpr FilterKernels kTable = {.leftRight = leftRightRow,
                                  .trustCodes = trustCodesOf,
                                  .trustPairs = trustPairsOf,
                                  .findRuns = findRuns,
                                  .uniteRuns = uniteRuns,
                                  .median3x3 = medianRow3x3,
                                  .median5x5 = medianRow5x5,
                                  .jointBilateral = jointBilateralBlock,
                                  .nearJumps = markNearJumps,
                                  .weightedMedian = weightedMedianAt,
                                  .refinePlanes = {refinePlanesRow<2>, refinePlanesRow<3>}};

}  // namespace
}  // namespace pomona
