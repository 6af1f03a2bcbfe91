// What the window methods do after the winners are picked: the engine's own checks, and its hole filling.
#pragma once

#include "baselines/winner.h"
#include "pomona/options.h"

namespace pomona {

/// Left-right check, speckle removal and median as `validation` asks for, in place. What is rejected loses
/// its disparity and confidence.
void validate(WindowMaps& maps, SearchRange range, const ValidationOptions& validation, int threads);

/// Gives every rejected pixel a disparity from its surroundings; its confidence stays 0. `guide`: the left
/// image.
void fill(WindowMaps& maps, GuideView guide, SearchRange range, int threads);

}  // namespace pomona
