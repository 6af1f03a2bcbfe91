// Which way the surroundings of an interest point face (section 4.1 of the paper).
#pragma once

#include "plugins/common/surf/integral_image.h"

namespace pomona {

/// The direction, in radians from the x-axis towards the y-axis, of the strongest sum of Haar responses that
/// lie within 60 degrees of each other. They are 4 s wide, s apart, no further than 6 s from (x, y), and
/// weighted by a Gaussian of 2 s; s = `scale`, in px. 0 where the image is flat.
float dominantOrientation(const IntegralImage& image, float x, float y, float scale);

}  // namespace pomona
