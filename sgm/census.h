// Census transform (Zabih & Woodfill 1994): a pixel becomes the bit string of its comparisons with its
// neighbours.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "pomona/options.h"
#include "sgm/kernels.h"

namespace pomona {

/// The bit patterns of every pixel, one image per byte of the code.
struct CensusPlanes {
  int planes = 0;
  std::array<Image<std::uint8_t>, kMaxCensusPlanes> plane;
};

/// `gray`: 8 or 16 bits per pixel. Beyond the border the nearest pixel counts. Costs other than census are
/// refused by assertion. Bits above the code's length are 0.
template <typename T>
class CensusTransform {
 public:
  void compute(ImageView<const T> gray, MatchingCost cost, CensusPlanes& out, const SgmKernels& kernels,
               int threads);

 private:
  Image<T> padded_;
};

}  // namespace pomona
