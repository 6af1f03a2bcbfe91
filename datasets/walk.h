// Finds the scenes of stereo data sets in a folder tree.
#pragma once

#include <string>
#include <vector>

#include "datasets/scene.h"

namespace pomona {

/// The scenes at and below each of `roots`, in the order of the roots and of the names below them:
/// - a folder with a manifest.csv: what that lists (see readManifest()), and nothing else below it;
/// - a folder with im0.png, im1.png or disp0GT.pfm (Middlebury 2014 and later, ETH3D two-view; for the
///   latter the truth may lie beside the split, in two_view_training_gt);
/// - a folder with im2/im6/disp2, view1/view5/disp1 or imL/imR/groundtruth (Middlebury 2001 to 2006);
/// - a folder with image_2 and image_3 (KITTI 2015), colored_0 and colored_1, or image_0 and image_1 (KITTI
///   2012): a scene for each frame NNNNNN_10.png.
/// Folders are followed through symbolic links, each once. No file is opened but manifests: a scene that
/// lacks an image is found, and readScene() says what is wrong with it; a manifest line or a folder that
/// cannot be read is found as a scene with a `problem`. Names are unique: where two folders hold scenes of
/// one name, the names of all their scenes begin with as many folders above as it takes
/// ("2012/training/000000_10"); a name that a manifest uses again is followed by a number ("pair-2"); control
/// characters are shown as '?'. Throws std::runtime_error if a root is no folder, or there is no scene below
/// it.
std::vector<SceneFiles> findScenes(const std::vector<std::string>& roots);

/// The scenes that a manifest lists: comma-separated lines, fields optionally in double quotes. The first
/// line names the columns, in any order: left and right (required), name, gt, mask, calib, max_disparity.
/// Paths are relative to the manifest's folder; max_disparity (a whole number, 1 to 1024) bounds the search
/// to [0, max_disparity). Throws std::runtime_error for a file without that first line, or with a quote that
/// never ends; a later line that makes no sense becomes a scene with a `problem`.
std::vector<SceneFiles> readManifest(const std::string& path);

}  // namespace pomona
