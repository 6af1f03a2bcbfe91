#include "datasets/pfm.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "datasets/disparity_file.h"
#include "file_support.h"

namespace pomona {
namespace {

using namespace std::string_literals;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// 1.0f and -2.0f, spelled out.
const std::string kLittleEndian = "\x00\x00\x80\x3f\x00\x00\x00\xc0"s;
const std::string kBigEndian = "\x3f\x80\x00\x00\xc0\x00\x00\x00"s;

bool sameBits(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), a.cols * a.elemSize()) != 0) return false;
  return true;
}

TEST(Pfm, WritesTheBytesTheFormatPrescribes) {
  const cv::Mat image = (cv::Mat_<float>(2, 1) << -2.0f, 1.0f);  // the bottom row comes first
  EXPECT_EQ(encodePfm(image), "Pf\n1 2\n-1\n" + kLittleEndian);
  const cv::Mat color(1, 1, CV_32FC3, cv::Scalar(0, -2.0, 1.0));  // blue 0, green -2, red 1
  EXPECT_EQ(encodePfm(color), "PF\n1 1\n-1\n" + kLittleEndian + "\0\0\0\0"s);
}

TEST(Pfm, ReadsBackWhatItWroteForAnySizeStrideAndChannelCount) {
  const TemporaryFolder folder;
  for (const int type : {CV_32FC1, CV_32FC3})
    for (const int width : {1, 2, 7, 33})
      for (const int height : {1, 2, 5}) {
        cv::Mat big(height + 4, width + 6, type, cv::Scalar::all(1e30));
        cv::Mat image = big(cv::Rect(3, 2, width, height));
        cv::randu(image, -100, 1000);
        image.ptr<float>(0)[0] = kInf;
        writePfm(folder / "a.pfm", image);
        EXPECT_TRUE(sameBits(readPfm(folder / "a.pfm"), image)) << type << ' ' << width << 'x' << height;
      }
}

TEST(Pfm, UnknownIsInfinityInTheFileAndNanInADisparityMap) {
  const TemporaryFolder folder;
  writePfm(folder / "a.pfm", (cv::Mat_<float>(1, 3) << kNan, 5, 0));
  const cv::Mat raw = readPfm(folder / "a.pfm");
  EXPECT_EQ(raw.at<float>(0), kInf);
  const cv::Mat disparity = readDisparity(folder / "a.pfm");
  EXPECT_TRUE(std::isnan(disparity.at<float>(0)));
  EXPECT_EQ(disparity.at<float>(1), 5);
  EXPECT_EQ(disparity.at<float>(2), 0);
}

TEST(Pfm, AcceptsBothByteOrdersAnyWhiteSpaceAndAnyScale) {
  const TemporaryFolder folder;
  const cv::Mat expected = (cv::Mat_<float>(1, 2) << 1.0f, -2.0f);
  const std::string files[] = {
      "Pf\n2 1\n-1\n" + kLittleEndian,
      "Pf\n2 1\n1\n" + kBigEndian,
      "Pf\r\n2 1\r\n-1.000000\r\n" + kLittleEndian,
      "Pf 2 1 +1 " + kBigEndian,
      "Pf\n2\n1\n-0.003922\n" + kLittleEndian,
      "Pf \t\n 2 \n\n 1 \r\n255e0\n" + kBigEndian,
      "Pf\n2 1\n-1\n" + kLittleEndian + "bytes after the last row",
  };
  for (const std::string& file : files)
    EXPECT_TRUE(sameBits(readPfm(put(folder / "a.pfm", file)), expected)) << file;
}

TEST(Pfm, WhiteSpaceThatIsDataIsNotSkipped) {
  const TemporaryFolder folder;
  const std::string spaces = "\x20\x0a\x0d\x09";  // one little-endian float made of white space
  const cv::Mat image = readPfm(put(folder / "a.pfm", "Pf\n1 1\n-1\n" + spaces));
  EXPECT_EQ(std::memcmp(image.ptr(), spaces.data(), 4), 0);
}

TEST(Pfm, RefusesMalformedFilesNamingPathByteAndExpectation) {
  const TemporaryFolder folder;
  const struct {
    std::string bytes, byte, text;
  } cases[] = {
      {"", "byte 0", "expected 'Pf' or 'PF', found the end"},
      {"P5\n2 1\n255\n", "byte 0", "found 'P5'"},
      {"\x89PNG\r\n", "byte 0", "found '?PNG'"},
      {"Pf\n", "byte 3", "a positive width, found the end"},
      {"Pf\nx 1\n", "byte 3", "found 'x'"},
      {"Pf\n0 1\n-1\n", "byte 3", "a positive width"},
      {"Pf\n2 -1\n-1\n", "byte 5", "a positive height"},
      {"Pf\n2.5 1\n-1\n", "byte 3", "found '2.5'"},
      {"Pf\n99999999999 1\n-1\n", "byte 3", "a positive width"},
      {"Pf\n2000000000 2000000000\n-1\n", "byte 14", "at most 2^31 bytes"},
      {"PF\n20000 20000\n-1\n", "byte 9", "at most 2^31 bytes"},
      {"Pf\n2 1\n0\n" + kBigEndian, "byte 7", "scale other than zero, found '0'"},
      {"Pf\n2 1\nnan\n" + kBigEndian, "byte 7", "scale"},
      {"Pf\n2 1\ninf\n" + kBigEndian, "byte 7", "scale"},
      {"Pf\n2 1\none\n" + kBigEndian, "byte 7", "scale"},
      {"Pf\n2 1\n-1", "byte 9", "white space"},
      {"Pf\n2 1\n-1\n", "byte 10", "expected 8 bytes of samples, found 0"},
      {"Pf\n2 1\n-1\n" + kLittleEndian.substr(0, 7), "byte 17", "expected 8 bytes of samples, found 7"},
  };
  for (const auto& c : cases) {
    const std::string path = put(folder / "bad.pfm", c.bytes);
    const std::string message = messageOf([&] { readPfm(path); });
    expectContains(message, path + ": " + c.byte + ":");
    expectContains(message, c.text);
  }
  expectContains(messageOf([&] { readPfm(folder / "absent.pfm"); }),
                 "absent.pfm: cannot be read: No such file");
  expectContains(messageOf([&] { readPfm(folder / "."); }), "directory");
}

TEST(Pfm, RefusesOtherImages) {
  expectContains(messageOf<std::invalid_argument>([] { encodePfm(cv::Mat(2, 2, CV_8U)); }), "CV_8U");
  EXPECT_THROW(encodePfm(cv::Mat(2, 2, CV_64F)), std::invalid_argument);
  EXPECT_THROW(encodePfm(cv::Mat(0, 0, CV_32F)), std::invalid_argument);
}

TEST(DisparityFile, RefusesColourAndUnknownExtensions) {
  const TemporaryFolder folder;
  writePfm(folder / "color.pfm", cv::Mat(2, 2, CV_32FC3, cv::Scalar::all(1)));
  expectContains(messageOf([&] { readDisparity(folder / "color.pfm"); }), "1 channel");
  expectContains(messageOf([&] { readDisparity(folder / "map.tif"); }), ".tif");
}

}  // namespace
}  // namespace pomona
