// Portable float maps, the format of Middlebury's and ETH3D's ground truth.
//
// "Pf" (one channel) or "PF" (three), width, height and scale as text, then 32-bit floats in rows from the
// bottom up. A negative scale means little-endian. Its magnitude is ignored: readers differ over its meaning,
// and disparities are pixels already.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace pomona {

/// CV_32FC1, or CV_32FC3 in OpenCV's order (blue first). Values are as in the file: infinities and NaNs stay.
/// Accepts either byte order, any white space (CRLF too) between header tokens, and bytes after the last row.
/// Throws std::runtime_error "path: byte N: expected ..., found ..." for a malformed header, a zero or
/// non-finite scale, a size that is not positive or holds more than 2^31 bytes, and a truncated file.
cv::Mat readPfm(const std::string& path);

/// The little-endian file for `image` (CV_32FC1, or CV_32FC3 with blue first), scale -1; NaN becomes +inf.
/// Throws std::invalid_argument for any other type and for an empty image.
std::string encodePfm(const cv::Mat& image);

/// Writes encodePfm(image) to `path`, completely or not at all.
void writePfm(const std::string& path, const cv::Mat& image);

}  // namespace pomona
