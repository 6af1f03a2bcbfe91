// How far away the things are that a detector sees.
#pragma once

#include "plugins/logo_range/detector.h"
#include "pomona/plugin.h"

namespace pomona {

enum class BoxRanging {
  kCenters,  ///< the views' boxes are paired; the disparity is that of their centres
  kDense,    ///< the surface that the dense map has in most of the left view's box (measureObject())
};

/// One entry in `objects` per box of the left view; those that have no partner, or no surface, say so.
SparseResult rangeBoxes(const RectifiedPair& pair, const StereoCalibration& rig, const PluginInputs& inputs,
                        Detector& detector, BoxRanging ranging);

}  // namespace pomona
