// Census transform (Zabih & Woodfill 1994): a pixel becomes the bit string of its comparisons with its
// neighbours.
#pragma once

#include <array>
#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "pomona/options.h"
#include "sgm/kernels.h"

namespace pomona {

/// The bit patterns of every pixel, one image per byte of the code.
struct CensusPlanes {
  int planes = 0;
  std::array<ImageView<std::uint8_t>, kMaxCensusPlanes> plane;
};

/// `gray`: 8 or 16 bits per pixel. Beyond the border the nearest pixel counts. Costs other than census are
/// refused by assertion. Bits above the code's length are 0. The result lies in the current scope of `arena`.
template <typename T>
CensusPlanes computeCensus(ImageView<const T> gray, MatchingCost cost, const SgmKernels& kernels,
                           Arena& arena, int threads);

}  // namespace pomona
