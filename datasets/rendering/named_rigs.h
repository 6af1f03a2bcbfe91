// Stereo cameras to render with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "datasets/render.h"
#include "pomona/rig.h"

namespace pomona {

/// "middlebury", "seed-003", "seed-003-b60".
std::vector<std::string> rigNames();

/// A rig whose rectified views are its ideal cameras, so that rectifying its pictures gives the geometry of
/// the ground truth. "seed-003": the harvesting robot's 1280 x 720 with f = 1056.6 px at a baseline of 120
/// mm, as the robot's figures imply; "seed-003-b60": at 60 mm, as is stated there; both with lenses of
/// moderate barrel distortion. "middlebury": 1482 x 994, f = 1990 px, 193 mm, doffs 62 px and no distortion,
/// much as the half-size scenes of 2014. Throws std::invalid_argument for another name.
StereoRig namedRig(std::string_view name);

/// The same with images `width` wide and `height` high: focal length and offsets grow with the width, and the
/// height is cropped or extended about the centre. Sides: 16..8192, else std::invalid_argument.
StereoRig resized(const StereoRig& rig, int width, int height);

/// An empty scene before the ideal cameras of `rig`.
SceneDescription sceneFor(const StereoRig& rig);

/// Lets the rig's own lenses take the pictures.
void takeThroughLenses(const StereoRig& rig, SceneDescription& scene);

/// Lets the right camera look down so that its picture lies `rows_px` rows higher, as where rows don't match.
/// Throws std::invalid_argument for more rows than there are.
void shiftRightView(double rows_px, SceneDescription& scene);

}  // namespace pomona
