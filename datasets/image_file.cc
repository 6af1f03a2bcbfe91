#include "datasets/image_file.h"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "datasets/input_file.h"

namespace pomona {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view kJpegSignature = "\xff\xd8\xff"sv;

std::uint32_t bigEndian(std::string_view bytes, std::size_t position, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[position + i]);
  return value;
}

// Chunks follow one another: length, type, data, checksum. The last one is IEND.
void requireCompletePng(const std::string& path, std::string_view bytes) {
  std::size_t position = kPngSignature.size();
  while (bytes.size() - position >= 12) {
    const std::size_t length = bigEndian(bytes, position, 4);
    if (bytes.size() - position - 12 < length) break;
    if (bytes.substr(position + 4, 4) == "IEND") return;
    position += 12 + length;
  }
  failAtByte(path, bytes.size(), "expected the rest of a PNG image, found the end of the file");
}

// Segments follow one another: 0xff, a marker, and for most a length. Only after a start of scan (SOS) come
// bytes that belong to none; there an 0xff is data when a zero or a restart marker follows. The last marker
// is EOI.
void requireCompleteJpeg(const std::string& path, std::string_view bytes) {
  constexpr unsigned kFill = 0xff, kEndOfImage = 0xd9, kStartOfScan = 0xda, kRestart0 = 0xd0,
                     kRestart7 = 0xd7;
  bool in_scan = false;
  std::size_t position = 2;
  while (position + 1 < bytes.size()) {
    const unsigned marker = static_cast<unsigned char>(bytes[position + 1]);
    if (static_cast<unsigned char>(bytes[position]) != 0xff || marker == kFill) {
      ++position;
    } else if (marker == kEndOfImage) {
      return;
    } else if ((in_scan && marker == 0) || (marker >= kRestart0 && marker <= kRestart7)) {
      position += 2;
    } else {
      if (bytes.size() - position < 4) break;
      in_scan = in_scan || marker == kStartOfScan;
      position += 2 + bigEndian(bytes, position + 2, 2);
    }
  }
  failAtByte(path, bytes.size(), "expected the rest of a JPEG image, found the end of the file");
}

}  // namespace

cv::Mat readImage(const std::string& path) {
  const std::string bytes = readFile(path);
  if (bytes.empty()) failAtByte(path, 0, "expected an image, found the end of the file");
  if (bytes.starts_with(kPngSignature)) requireCompletePng(path, bytes);
  if (bytes.starts_with(kJpegSignature)) requireCompleteJpeg(path, bytes);
  cv::Mat image;
  try {
    const cv::Mat file(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(file, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& e) {
    throw std::runtime_error(
        path +
        ": is damaged, or beyond what OpenCV decodes (2^20 pixels wide or high, 2^30 in all): " + e.err);
  }
  if (image.empty()) throw std::runtime_error(path + ": is not an image, or is a damaged one");
  return image;
}

std::string encodeImage(const cv::Mat& image, const std::string& extension) {
  const bool fits =
      (image.depth() == CV_8U || image.depth() == CV_16U) && (image.channels() == 1 || image.channels() == 3);
  if (image.empty() || !fits)
    throw std::invalid_argument("image has " + describeType(image) +
                                "; allowed: 1 or 3 channels of 8 or 16 bits");
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string describeType(const cv::Mat& image) {
  if (image.empty()) return "0 pixels";
  const int depth = image.depth();
  const std::string bits = std::to_string(8 * image.elemSize1());
  const std::string kind = depth == CV_8U || depth == CV_16U    ? " bits"
                           : depth == CV_32F || depth == CV_64F ? "-bit floats"
                                                                : "-bit signed integers";
  return std::to_string(image.channels()) + (image.channels() == 1 ? " channel of " : " channels of ") +
         bits + kind;
}

}  // namespace pomona
