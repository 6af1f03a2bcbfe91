#include "datasets/png16.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "datasets/disparity_file.h"
#include "datasets/image_file.h"
#include "file_support.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(DisparityPng, StoresRoundedStepsAndKeepsKnownPixelsKnown) {
  const TemporaryFolder folder;
  const cv::Mat disparity = (cv::Mat_<float>(2, 4) << kNan, 0, 1 / 600.0f, 1 / 256.0f, 1.4990f / 256,
                             1.5f / 256, 255.99609375f, 100.25f);
  const cv::Mat steps = readImage(put(folder / "a.png", encodeDisparityPng(disparity, kKittiScale)));
  ASSERT_EQ(steps.type(), CV_16UC1);
  const int expected[] = {0, 1, 1, 1, 1, 2, 65535, 25664};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(steps.at<std::uint16_t>(i / 4, i % 4), expected[i]) << i;

  const cv::Mat back = readDisparity(folder / "a.png");
  EXPECT_TRUE(std::isnan(back.at<float>(0, 0)));
  EXPECT_EQ(back.at<float>(0, 1), 1 / 256.0f);
  EXPECT_EQ(back.at<float>(1, 2), 255.99609375f);
  EXPECT_EQ(back.at<float>(1, 3), 100.25f);
}

TEST(DisparityPng, SixteenthsReachFurther) {
  const TemporaryFolder folder;
  const cv::Mat disparity = (cv::Mat_<float>(1, 3) << kNan, 1000.5f, 0.01f);
  put(folder / "a.png", encodeDisparityPng(disparity, kOpenCvScale));
  EXPECT_EQ(readImage(folder / "a.png").at<std::uint16_t>(1), 16008);
  const cv::Mat back = readDisparityPng(folder / "a.png", kOpenCvScale);
  EXPECT_TRUE(std::isnan(back.at<float>(0)));
  EXPECT_EQ(back.at<float>(1), 1000.5f);
  EXPECT_EQ(back.at<float>(2), 1 / 16.0f);
}

TEST(DisparityPng, RefusesWhatDoesNotFitNamingThePixel) {
  for (const float bad : {-0.001f, -3.0f, 255.999f, 256.0f, 1e9f, std::numeric_limits<float>::infinity()}) {
    cv::Mat disparity(3, 5, CV_32F, cv::Scalar(1));
    disparity.at<float>(2, 4) = bad;
    const auto message =
        messageOf<std::invalid_argument>([&] { encodeDisparityPng(disparity, kKittiScale); });
    expectContains(message, "x 4, y 2");
    expectContains(message, "0 to 255.99");
  }
  EXPECT_THROW(encodeDisparityPng(cv::Mat(2, 2, CV_8U), kKittiScale), std::invalid_argument);
  EXPECT_THROW(encodeDisparityPng(cv::Mat(), kKittiScale), std::invalid_argument);
}

TEST(DisparityPng, RefusesOtherPngs) {
  const TemporaryFolder folder;
  put(folder / "a.png", encodeImage(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(9))));
  expectContains(messageOf([&] { readDisparityPng(folder / "a.png", kKittiScale); }),
                 "found 3 channels of 8 bits");
}

TEST(DepthPng, CountsMillimetresAndCallsWhatDoesNotFitUnknown) {
  const TemporaryFolder folder;
  const cv::Mat depth = (cv::Mat_<float>(1, 7) << kNan, 1.0f, 1.2346f, 65.535f, 65.536f, -1.0f, 0.0002f);
  const cv::Mat mm = readImage(put(folder / "a.png", encodeDepthPng(depth)));
  const int expected[] = {0, 1000, 1235, 65535, 0, 0, 0};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(mm.at<std::uint16_t>(i), expected[i]) << i;
}

}  // namespace
}  // namespace pomona
