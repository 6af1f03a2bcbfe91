// Median filter for disparity maps with unknown pixels.
#pragma once

#include "core/image.h"
#include "filters/kernels.h"

namespace pomona {

struct MedianScratch {
  Image<float> rows;  // of each strip, those around the current one and after its end
};

/// out(p) = the median of the known (not NaN) disparities in the size x size window around p, clipped to the
/// image; of an even number of values, the lower of the two middle ones. Unknown pixels stay unknown.
///
/// `size`: 3 or 5 pixels; throws std::invalid_argument for another. `in` and `out` have the same size; `out`
/// may be `in`. Disparities are finite or NaN.
void medianFilter(ImageView<const float> in, ImageView<float> out, int size, const FilterKernels& kernels,
                  MedianScratch& scratch, int threads);

}  // namespace pomona
