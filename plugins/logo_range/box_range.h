// How far away the things are that a detector sees.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/logo_range/detector.h"
#include "pomona/plugin.h"

namespace pomona {

enum class BoxRanging {
  kCenters,  ///< the views' boxes are paired; the disparity is that of their centres
  kDense,    ///< the surface that the dense map has in most of the left view's box (measureObject())
};

/// What a detector saw; without centres to pair, the right view's boxes may be missing.
struct Boxes {
  std::vector<Detection> left, right;
};

/// One entry in `objects` per box of the left view; those that have no partner, or no surface, say so.
/// `labels` by class.
SparseResult rangeBoxes(const Boxes& boxes, const StereoCalibration& rig, BoxRanging ranging,
                        const std::function<const StereoResult&()>& dense,
                        const std::function<std::string(int)>& label_of);

}  // namespace pomona
