// The table that makes the sum over a box of any size cost four look-ups.
#pragma once

#include <cstdint>

#include "core/image.h"

namespace pomona {

/// Sums of gray values over all rows above and all columns to the left. They are kept modulo 2^32, and so are
/// the differences that make a box of them: a box whose sum fits 31 bits comes out exact, in images of any
/// size.
class IntegralImage {
 public:
  explicit IntegralImage(ImageView<const std::uint8_t> gray);

  int width() const { return sums_.width() - 1; }    ///< of the image
  int height() const { return sums_.height() - 1; }  ///< of the image
  /// `row(y)[x]`: the sum of the pixels (u, v) with u < x and v < y; 0 <= x <= width, 0 <= y <= height.
  const std::uint32_t* row(int y) const { return sums_.row(y); }

 private:
  Image<std::uint32_t> sums_;
};

}  // namespace pomona
