// Disparity maps in whichever file format the path's extension names.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace pomona {

/// CV_32F with NaN for unknown (infinities in a PFM mean unknown too) from a .pfm or a KITTI-style .png file.
/// Throws std::runtime_error naming the file for everything that is wrong with it.
cv::Mat readDisparity(const std::string& path);

}  // namespace pomona
