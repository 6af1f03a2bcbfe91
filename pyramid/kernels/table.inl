// Everything an instruction set's target file compiles: the bodies, and the table of them.
#include "core/simd/float.h"
#include "pyramid/kernels.h"
// clang-format off: the bodies have no includes of their own
#include "pyramid/kernels/candidates.inl"
#include "pyramid/kernels/laplacian.inl"
#include "pyramid/kernels/planes.inl"
#include "pyramid/kernels/rays.inl"
#include "pyramid/kernels/scale.inl"
#include "pyramid/kernels/segments.inl"
// clang-format on

namespace pomona {
namespace {

constexpr PyramidKernels kTable = {
    .accumulate8 = accumulate<std::uint8_t>,
    .accumulate16 = accumulate<std::uint16_t>,
    .cubicRow = cubicRow,
    .cubicColumn = cubicColumn,
    .reduceRow = reduceRow,
    .reduceColumn = reduceColumn,
    .expandRow = expandRow,
    .addExpandedColumn = addExpandedColumn,
    .average = average,
    .findHoles = findHoles,
    .advanceRays = advanceRays,
    .difference1 = difference1,
    .largestDifference3 = largestDifference3,
    .countSourcesAndHoles = countSourcesAndHoles,
    .countNearPlane = countNearPlane,
    .planeDisparities = planeDisparities,
    .localResidual = localResidual,
    .correlate = correlate,
    .gatherCandidates = gatherCandidates,
    .candidateMedian = candidateMedian,
};

}  // namespace
}  // namespace pomona
