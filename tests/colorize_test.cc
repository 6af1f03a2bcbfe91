#include "datasets/colorize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const cv::Vec3b kBlack{0, 0, 0}, kWhite{255, 255, 255};

TEST(DisparityColors, WarmIsNearColdIsFarBlackIsUnknown) {
  const cv::Mat disparity = (cv::Mat_<float>(1, 6) << kNan, -1e9f, 5, 10, 15, 1e9f);
  const cv::Mat image = colorizeDisparity(disparity, {5, 15});
  EXPECT_EQ(image.type(), CV_8UC3);
  const auto color = [&](int x) { return image.at<cv::Vec3b>(0, x); };
  EXPECT_EQ(color(0), kBlack);
  EXPECT_EQ(color(1), color(2));
  EXPECT_EQ(color(4), color(5));
  EXPECT_GT(color(2)[0], color(2)[2]);  // far: more blue than red
  EXPECT_LT(color(4)[0], color(4)[2]);  // near: more red than blue
  EXPECT_NE(color(2), kBlack);
}

TEST(DisparityColors, NeighbouringDisparitiesHaveNeighbouringColorsAndNoTwoAreAlike) {
  cv::Mat disparity(1, 101, CV_32F);
  for (int x = 0; x <= 100; ++x) disparity.at<float>(x) = static_cast<float>(x);
  const cv::Mat image = colorizeDisparity(disparity, {0, 100});
  std::set<std::tuple<int, int, int>> seen;
  for (int x = 0; x <= 100; ++x) {
    const auto c = image.at<cv::Vec3b>(0, x);
    EXPECT_TRUE(seen.emplace(c[0], c[1], c[2]).second) << x;
    EXPECT_LT(cv::norm(c, image.at<cv::Vec3b>(0, std::max(0, x - 1))), 20) << x;
  }
}

TEST(TypicalRange, LeavesOutExtremesAndUnknowns) {
  cv::Mat disparity(20, 50, CV_32F);
  for (int i = 0; i < 1000; ++i) disparity.at<float>(i / 50, i % 50) = static_cast<float>(i);
  disparity.at<float>(0, 0) = -1e6f;
  disparity.at<float>(19, 49) = 1e6f;
  const DisparityRange range = typicalRange(disparity);
  EXPECT_NEAR(range.low, 10, 2);
  EXPECT_NEAR(range.high, 990, 2);
  disparity.setTo(kNan);
  EXPECT_EQ(typicalRange(disparity).low, 0);
  EXPECT_EQ(typicalRange(disparity).high, 1);
  disparity.at<float>(3, 3) = 7;
  EXPECT_EQ(typicalRange(disparity).low, 7);
  EXPECT_EQ(typicalRange(disparity).high, 8);
}

TEST(StateColors, AreDistinctForEveryState) {
  std::set<std::tuple<int, int, int>> seen{{255, 255, 255}};
  cv::Mat states(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) states.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  const cv::Mat image = colorizeStates(states);
  for (const int state : {0, 1, 2, 3, 4, 16, 17, 18, 19, 20, 21}) {
    const auto c = image.at<cv::Vec3b>(0, state);
    EXPECT_TRUE(seen.emplace(c[0], c[1], c[2]).second) << state;
    EXPECT_EQ(c, stateColor(static_cast<PixelState>(state)));
  }
  for (const int other : {5, 15, 22, 255}) EXPECT_EQ(image.at<cv::Vec3b>(0, other), kWhite) << other;
}

TEST(ConfidenceGray, SpansTheBytes) {
  const cv::Mat gray = confidenceToGray((cv::Mat_<float>(1, 6) << 0, 0.5f, 1, 2, -1, kNan));
  const int expected[] = {0, 128, 255, 255, 0, 0};
  for (int x = 0; x < 6; ++x) EXPECT_EQ(gray.at<std::uint8_t>(x), expected[x]) << x;
}

TEST(ErrorColors, GreenIsRightRedIsWrongBlackIsUnknownWhiteIsAHole) {
  const cv::Mat truth = (cv::Mat_<float>(1, 6) << 10, 10, 10, 10, kNan, 10);
  const cv::Mat disparity = (cv::Mat_<float>(1, 6) << 10, 14, 6, 100, 10, kNan);
  const cv::Mat image = colorizeError(disparity, truth);
  const auto color = [&](int x) { return image.at<cv::Vec3b>(0, x); };
  EXPECT_GT(color(0)[1], color(0)[2]);
  EXPECT_GT(color(1)[2], color(1)[1]);
  EXPECT_EQ(color(1), color(2));
  EXPECT_EQ(color(1), color(3));
  EXPECT_EQ(color(4), kBlack);
  EXPECT_EQ(color(5), kWhite);
}

TEST(Colorize, RefusesOtherTypesAndSizes) {
  const cv::Mat floats(2, 2, CV_32F, cv::Scalar(0)), bytes(2, 2, CV_8U, cv::Scalar(0));
  EXPECT_THROW(colorizeDisparity(bytes, {0, 1}), std::invalid_argument);
  EXPECT_THROW(colorizeStates(floats), std::invalid_argument);
  EXPECT_THROW(confidenceToGray(bytes), std::invalid_argument);
  EXPECT_THROW(colorizeError(floats, bytes), std::invalid_argument);
  EXPECT_THROW(colorizeError(floats, cv::Mat(2, 3, CV_32F)), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
