// The range of disparities that a scene takes.
#pragma once

#include "datasets/render.h"

namespace pomona {

/// A bound on the disparities of the left view, a multiple of 16: from the bounding boxes of the surfaces
/// that lie in front of the cameras, and from the planes at the image's corners.
int disparitiesFor(const SceneDescription& scene);

}  // namespace pomona
