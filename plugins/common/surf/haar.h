// Haar wavelets at any place and of any size: first derivatives, averaged over a box.
#pragma once

#include <cstdint>

#include "plugins/common/surf/integral_image.h"

namespace pomona {

/// A length in sixteenths of a pixel. At this precision all that follows is integer arithmetic, and exact.
constexpr int kFixedOne = 16;
inline int toFixed(float px) {
  const float scaled = px * kFixedOne;
  return static_cast<int>(scaled < 0 ? scaled - 0.5f : scaled + 0.5f);
}

/// Right half minus left half, and lower half minus upper half.
struct HaarResponse {
  float dx, dy;
};

/// The wavelet whose square reaches `half` (> 0, up to 128 px) from (x, y) on all four sides; all are
/// fixed-point pixel coordinates, whole numbers of pixels being centres of pixels. A pixel that the square or
/// its halves cut counts by the share inside. Where the square leaves the image the response is 0.
HaarResponse haarResponse(const IntegralImage& image, int x, int y, int half);

}  // namespace pomona
