// Moves the right view of a pair whose rows do not match to where they do.
#pragma once

#include <cstdint>
#include <optional>

#include "camera/kernels.h"
#include "camera/row_check.h"
#include "core/image.h"

namespace pomona {

/// By how much the rows of the right view should move; nothing if they had better stay where they are: the
/// offset is unknown or below 0.1 px, where moving gains nothing, or its points disagree (half of them lie
/// more than 0.25 px off their plane). It is the median, the same all over the view; or the plane, if that is
/// tilted by more than 0.5 px: views that are aligned have tilted it by up to 0.3 px.
std::optional<RowOffsetPlane> rowCorrection(const RowOffsets& rows);

/// Resamples `right` where it shows the rows of the left view: out(x, y) = right(x, y + offset(x, y)), by
/// cubic interpolation down the column (R. G. Keys, "Cubic convolution interpolation for digital image
/// processing", IEEE Trans. ASSP 29(6), 1981, with a = -1/2), in steps of 1/64 px. The view continues beyond
/// its border as its nearest row. `out` gets the size of `right`, and is another image. The result does not
/// depend on `threads`.
template <typename T>
void alignRows(ImageView<const T> right, const RowOffsetPlane& offset, Image<T>& out,
               const CameraKernels& kernels, int threads);

extern template void alignRows(ImageView<const std::uint8_t>, const RowOffsetPlane&, Image<std::uint8_t>&,
                               const CameraKernels&, int);
extern template void alignRows(ImageView<const std::uint16_t>, const RowOffsetPlane&, Image<std::uint16_t>&,
                               const CameraKernels&, int);

}  // namespace pomona
