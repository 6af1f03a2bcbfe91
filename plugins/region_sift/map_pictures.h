// The map that ranged points make, drawn from the front and from above.
#pragma once

#include <vector>

#include "pomona/sparse_result.h"

namespace pomona {

/// "map-front": X to the right, height above the floor upwards; "map-top": X to the right, depth Z upwards,
/// the robot at the lower edge. A grid of metres; near points warm. `camera_height_m`: of the left camera
/// above the floor. No pictures without points.
std::vector<SparsePicture> mapPictures(const std::vector<SparsePoint>& points, double camera_height_m);

}  // namespace pomona
