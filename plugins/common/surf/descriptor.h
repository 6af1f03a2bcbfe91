// What the surroundings of an interest point look like, in 64 or 128 numbers (section 4.2 of the paper).
#pragma once

#include "plugins/common/surf/integral_image.h"

namespace pomona {

struct DescriptorFrame {
  float x, y;       ///< px
  float scale;      ///< px
  float angle = 0;  ///< radians, from the x-axis towards the y-axis
};

constexpr int descriptorLength(bool extended) {
  return extended ? 128 : 64;
}

/// A square of 20 s, turned by the angle, is cut into 4 x 4 cells of 5 x 5 Haar responses of 2 s each,
/// weighted by a Gaussian of 3.3 s. A cell gives sum dx, sum |dx|, sum dy, sum |dy|; extended, each dx sum
/// once for dy < 0 and once for the others, and each dy sum once for dx < 0 and once for the others. Other
/// than in the paper, a response counts in the neighbouring cells, too, by how near it is to their middles:
/// where a response lies right between two cells, little depends on which. `out` has descriptorLength()
/// values and length 1, or is 0 where the image is flat. What lies outside the image counts as flat.
void describe(const IntegralImage& image, const DescriptorFrame& frame, bool extended, float* out);

}  // namespace pomona
