#include "datasets/image_file.h"

#include <cstdint>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "file_support.h"

namespace pomona {
namespace {

cv::Mat picture(int type) {
  cv::Mat image(40, 50, type);
  cv::randu(image, 0, image.depth() == CV_16U ? 65535 : 255);
  cv::blur(image, image, cv::Size(5, 5));
  return image;
}

std::string encode(const std::string& extension, const cv::Mat& image,
                   const std::vector<int>& parameters = {}) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

class ImageFile : public testing::Test {
 protected:
  void SetUp() override { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }
  TemporaryFolder folder_;
};

TEST_F(ImageFile, ReturnsPngsUnchanged) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3}) {
    const cv::Mat image = picture(type);
    const cv::Mat back = readImage(put(folder_ / "a.png", encode(".png", image)));
    ASSERT_EQ(back.type(), type);
    EXPECT_EQ(cv::norm(image, back, cv::NORM_INF), 0) << type;
  }
}

TEST_F(ImageFile, RefusesEveryTruncationOfEveryFormat) {
  const struct {
    std::string extension, bytes;
  } files[] = {
      {".png", encode(".png", picture(CV_8UC3))},
      {".jpg", encode(".jpg", picture(CV_8UC3))},
      {".jpg", encode(".jpg", picture(CV_8UC3), {cv::IMWRITE_JPEG_PROGRESSIVE, 1})},
      {".jpg", encode(".jpg", picture(CV_8UC3), {cv::IMWRITE_JPEG_RST_INTERVAL, 2})},
      {".pgm", encode(".pgm", picture(CV_8UC1))},
      {".ppm", encode(".ppm", picture(CV_16UC3))},
      {".bmp", encode(".bmp", picture(CV_8UC3))},
      {".tif", encode(".tif", picture(CV_16UC1))},
  };
  for (const auto& file : files) {
    const std::string path = folder_ / ("a" + file.extension);
    const cv::Mat whole = readImage(put(path, file.bytes));
    EXPECT_EQ(whole.cols, 50) << path;
    const auto refusedOrWhole = [&] {
      try {
        return cv::norm(readImage(path), whole, cv::NORM_INF) == 0;
      } catch (const std::runtime_error&) {
        return true;
      }
    };
    for (std::size_t size = 0; size < file.bytes.size(); size += 1 + size / 12) {
      put(path, file.bytes.substr(0, size));
      EXPECT_THROW(readImage(path), std::runtime_error)
          << path << " of " << file.bytes.size() << " cut to " << size;
    }
    for (std::size_t missing = 1; missing < 20; ++missing) {  // a TIFF's last bytes are not pixels
      put(path, file.bytes.substr(0, file.bytes.size() - missing));
      EXPECT_TRUE(refusedOrWhole()) << path << " without its last " << missing << " bytes";
    }
  }
}

TEST_F(ImageFile, TruncationIsReportedWithItsByte) {
  const std::string bytes = encode(".png", picture(CV_8UC1));
  const std::string path = put(folder_ / "a.png", bytes.substr(0, 100));
  expectContains(messageOf([&] { readImage(path); }), path + ": byte 100: expected the rest of a PNG");
}

// A thumbnail inside a JPEG has an end marker of its own, which must not pass for the picture's.
TEST_F(ImageFile, EndMarkerInsideASegmentDoesNotCount) {
  std::string bytes = encode(".jpg", picture(CV_8UC3));
  const std::string comment("\xff\xfe\x00\x06\xff\xd8\xff\xd9", 8);
  bytes.insert(2, comment);
  EXPECT_EQ(readImage(put(folder_ / "a.jpg", bytes)).cols, 50);
  EXPECT_THROW(readImage(put(folder_ / "b.jpg", bytes.substr(0, bytes.size() / 2))), std::runtime_error);
}

TEST_F(ImageFile, TrailingBytesAreHarmless) {
  EXPECT_EQ(readImage(put(folder_ / "a.jpg", encode(".jpg", picture(CV_8UC3)) + "more")).cols, 50);
  EXPECT_EQ(readImage(put(folder_ / "a.png", encode(".png", picture(CV_8UC3)) + "more")).cols, 50);
}

TEST_F(ImageFile, RefusesDamagedAndForeignFiles) {
  std::string bytes = encode(".png", picture(CV_8UC3));
  bytes[bytes.size() / 2] ^= 0x55;
  EXPECT_THROW(readImage(put(folder_ / "a.png", bytes)), std::runtime_error);
  expectContains(messageOf([&] { readImage(put(folder_ / "b.png", "not an image")); }),
                 "b.png: is not an image");
  expectContains(messageOf([&] { readImage(put(folder_ / "huge.pgm", "P5\n99999 99999\n255\n")); }),
                 "beyond what OpenCV decodes (2^20 pixels wide or high, 2^30 in all)");
  expectContains(messageOf([&] { readImage(put(folder_ / "c.png", "")); }), "c.png: byte 0");
  expectContains(messageOf([&] { readImage(folder_ / "absent.png"); }), "No such file");
}

TEST_F(ImageFile, EncodesWhatItCanAndRefusesTheRest) {
  const cv::Mat image = picture(CV_16UC3);
  EXPECT_EQ(cv::norm(readImage(put(folder_ / "a.png", encodeImage(image))), image, cv::NORM_INF), 0);
  const cv::Mat states(2, 3, CV_8UC1, cv::Scalar(20));
  EXPECT_EQ(encodeImage(states, ".pgm").substr(0, 2), "P5");
  EXPECT_THROW(encodeImage(cv::Mat(2, 2, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(encodeImage(cv::Mat(2, 2, CV_8UC4)), std::invalid_argument);
  EXPECT_THROW(encodeImage(cv::Mat()), std::invalid_argument);
}

TEST_F(ImageFile, DescribesTypesInWords) {
  EXPECT_EQ(describeType(cv::Mat(1, 1, CV_8UC4)), "4 channels of 8 bits");
  EXPECT_EQ(describeType(cv::Mat(1, 1, CV_32FC1)), "1 channel of 32-bit floats");
  EXPECT_EQ(describeType(cv::Mat(1, 1, CV_16SC1)), "1 channel of 16-bit signed integers");
}

}  // namespace
}  // namespace pomona
