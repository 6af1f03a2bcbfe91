// Image files through OpenCV's codecs, without their habit of returning half an image.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace pomona {

/// The image as stored (cv::IMREAD_UNCHANGED: depth, channels and orientation untouched). PNG and JPEG files
/// are first checked to be complete. Throws std::runtime_error naming the path, and for truncated files the
/// byte.
cv::Mat readImage(const std::string& path);

/// `image` (8 or 16 bits, 1 or 3 channels) as a file of the format `extension` names: ".png", ".pgm" (1
/// channel). Throws std::invalid_argument for other images.
std::string encodeImage(const cv::Mat& image, const std::string& extension = ".png");

/// "3 channels of 8 bits", "1 channel of 32-bit floats".
std::string describeType(const cv::Mat& image);

}  // namespace pomona
