// The colours of surfaces, as functions of a place on them.
#pragma once

#include <opencv2/core.hpp>

#include "datasets/rendering/solid.h"

namespace pomona {

/// BGR of `solid` at `point`, a place on it, before light. `pixel_m`: the side of a pixel there; octaves of
/// noise with cells below two pixels fade, and are gone at one, lest what no pixel can show make the views
/// differ. (Pattern::kNoise doesn't.)
cv::Vec3d paintAt(const Solid& solid, const cv::Vec3d& point, double pixel_m);

/// Whether (x, y) is inside the letters of `text`, which stand side by side in the rectangle 0..1 x 0..1, y
/// down: capital letters; anything else is a gap.
bool isInText(const std::string& text, double x, double y);

}  // namespace pomona
