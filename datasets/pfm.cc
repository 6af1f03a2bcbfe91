#include "datasets/pfm.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "datasets/atomic_file.h"
#include "datasets/input_file.h"

namespace pomona {
namespace {

constexpr std::int64_t kMaxPayloadBytes = std::int64_t{1} << 31;

struct Header {
  int channels;
  int width;
  int height;
  bool little_endian;
  std::size_t data_begin;  // offset of the first sample
};

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

class HeaderReader {
 public:
  HeaderReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  Header read() {
    Header header{};
    next("'Pf' or 'PF'");
    if (token_ != "Pf" && token_ != "PF") fail("'Pf' or 'PF'");
    header.channels = token_ == "PF" ? 3 : 1;
    header.width = size("a positive width");
    header.height = size("a positive height");
    const std::int64_t pixels = std::int64_t{header.width} * header.height;
    if (pixels > kMaxPayloadBytes / (4 * header.channels)) fail("a size of at most 2^31 bytes");
    double scale = 0;
    next("a scale");
    if (!parseNumber(token_, scale) || !std::isfinite(scale) || scale == 0)
      fail("a finite scale other than zero");
    header.little_endian = scale < 0;
    header.data_begin = skipLineEnd();
    return header;
  }

 private:
  // The only white space that is counted: one byte, or a CRLF pair. More of it could be the first sample.
  std::size_t skipLineEnd() {
    if (position_ == bytes_.size())
      failAtByte(path_, position_, "expected white space, found the end of the file");
    const bool pair =
        bytes_[position_] == '\r' && position_ + 1 < bytes_.size() && bytes_[position_ + 1] == '\n';
    return position_ + (pair ? 2 : 1);
  }

  int size(const char* expected) {
    int value = 0;
    next(expected);
    if (!parseNumber(token_, value) || value <= 0) fail(expected);
    return value;
  }

  void next(const char* expected) {
    while (position_ < bytes_.size() && isSpace(bytes_[position_])) ++position_;
    begin_ = position_;
    while (position_ < bytes_.size() && !isSpace(bytes_[position_])) ++position_;
    token_ = bytes_.substr(begin_, position_ - begin_);
    if (token_.empty())
      failAtByte(path_, begin_, std::string("expected ") + expected + ", found the end of the file");
  }

  [[noreturn]] void fail(const char* expected) {
    failAtByte(path_, begin_, std::string("expected ") + expected + ", found " + quoted(token_));
  }

  const std::string& path_;
  std::string_view bytes_;
  std::string_view token_;
  std::size_t begin_ = 0;
  std::size_t position_ = 0;
};

float loadSample(const char* bytes, bool little_endian) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
    bits |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (little_endian ? 8 * i : 24 - 8 * i);
  return std::bit_cast<float>(bits);
}

void storeSample(char* bytes, float value) {
  const auto bits =
      std::bit_cast<std::uint32_t>(std::isnan(value) ? std::numeric_limits<float>::infinity() : value);
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(bits >> (8 * i));
}

// Where sample x of a row lies: files store red first, OpenCV blue first.
std::size_t sampleOffset(int x, int channels) {
  return 4 * static_cast<std::size_t>(channels == 1 ? x : x - x % 3 + (2 - x % 3));
}

}  // namespace

cv::Mat readPfm(const std::string& path) {
  const std::string bytes = readFile(path);
  const Header header = HeaderReader(path, bytes).read();
  const std::size_t row_bytes = std::size_t{4} * header.width * header.channels;
  const std::size_t needed = row_bytes * header.height;
  if (bytes.size() - header.data_begin < needed)
    failAtByte(path, bytes.size(),
               "expected " + std::to_string(needed) + " bytes of samples, found " +
                   std::to_string(bytes.size() - header.data_begin));
  cv::Mat image(header.height, header.width, CV_MAKETYPE(CV_32F, header.channels));
  for (int y = 0; y < header.height; ++y) {
    const char* row = bytes.data() + header.data_begin + row_bytes * (header.height - 1 - y);
    float* out = image.ptr<float>(y);
    for (int x = 0; x < header.width * header.channels; ++x)
      out[x] = loadSample(row + sampleOffset(x, header.channels), header.little_endian);
  }
  return image;
}

std::string encodePfm(const cv::Mat& image) {
  if (image.empty() || (image.type() != CV_32FC1 && image.type() != CV_32FC3))
    throw std::invalid_argument("image is " + cv::typeToString(image.type()) +
                                (image.empty() ? " and empty" : "") +
                                "; a PFM file holds CV_32FC1 or CV_32FC3 with at least one pixel");
  const int channels = image.channels();
  std::string bytes = (channels == 3 ? "PF\n" : "Pf\n") + std::to_string(image.cols) + " " +
                      std::to_string(image.rows) + "\n-1\n";
  const std::size_t row_bytes = std::size_t{4} * image.cols * channels;
  std::size_t position = bytes.size();
  bytes.resize(position + row_bytes * image.rows);
  for (int y = image.rows - 1; y >= 0; --y, position += row_bytes) {
    const float* row = image.ptr<float>(y);
    for (int x = 0; x < image.cols * channels; ++x)
      storeSample(bytes.data() + position + sampleOffset(x, channels), row[x]);
  }
  return bytes;
}

void writePfm(const std::string& path, const cv::Mat& image) {
  writeFile(path, encodePfm(image));
}

}  // namespace pomona
