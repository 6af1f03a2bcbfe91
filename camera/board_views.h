// Which views of a chessboard tell something that no other view tells, and why there are too few of them.
#pragma once

#include <string>
#include <vector>

#include "camera/calibrate.h"

namespace pomona {

/// Marks in `report`, which has an entry for each of `views`, those that tell nothing new: whose corners lie
/// at the same places (to half a pixel) on the left and on the right, or in both images as in a view before
/// it. From such views any camera, and a baseline of about 0, could follow.
void rejectAlike(const std::vector<BoardView>& views, CalibrationReport& report);

/// "2 of 5 views can be used; at least 3 are needed; rejected: a.png, b.png (reason), ...": each reason once,
/// with the first three of its views.
std::string tooFewViews(const CalibrationReport& report, int needed);

/// Why cameras that fit the views of `report` best are impossible, as `reason` says they are: most often, the
/// views are too alike to tell one camera from another. `views` are those of rejectAlike().
std::string impossibleCameras(const std::vector<BoardView>& views, const CalibrationReport& report,
                              cv::Size image_size, const std::string& reason);

}  // namespace pomona
