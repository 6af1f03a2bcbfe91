#include "evaluation/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace pomona {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

cv::Mat row(std::vector<float> values) {
  return cv::Mat(values, true).reshape(1, 1);
}

TEST(CompareWithTruth, CountsByHand) {
  //                             exact   on .5   over .5  over 1   hole   hole   unknown  unknown  over 4
  const cv::Mat truth = row({/**/ 10.f, 10.00f, 10.000f, 10.00f, 10.f, 10.00f, kInf, kNan, 10.f});
  const cv::Mat found = row({/**/ 10.f, 10.50f, 10.625f, 11.25f, kNan, kInf, 10.f, kNan, 15.f});
  const DisparityErrors e = compareWithTruth(found, truth);
  EXPECT_EQ(e.known, 7);
  EXPECT_EQ(e.holes, 2);
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{3, 2, 1, 1}));
  EXPECT_DOUBLE_EQ(e.error_sum_px, 0.5 + 0.625 + 1.25 + 5);
  EXPECT_DOUBLE_EQ(e.badPercent(0), 100.0 * 5 / 7);
  EXPECT_DOUBLE_EQ(e.badPercent(1), 100.0 * 4 / 7);
  EXPECT_DOUBLE_EQ(e.wrongPercent(2), 100.0 * 1 / 5);
  EXPECT_DOUBLE_EQ(e.coveragePercent(), 100.0 * 5 / 7);
  EXPECT_DOUBLE_EQ(e.averageErrorPx(), 7.375 / 5);
}

TEST(CompareWithTruth, AnErrorOfExactlyTheThresholdIsNotBad) {
  const DisparityErrors e = compareWithTruth(row({9.5f, 11.f, 8.f, 14.f}), row({10.f, 10.f, 10.f, 10.f}));
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{3, 2, 1, 0}));
}

TEST(CompareWithTruth, TheMaskLeavesOnly255) {
  const std::vector<std::uint8_t> mask = {255, 128, 0, 255, 254};
  const DisparityErrors e =
      compareWithTruth(row({1, 9, 9, kNan, 9}), row({1, 1, 1, 1, 1}), cv::Mat(mask, true).t());
  EXPECT_EQ(e.known, 2);
  EXPECT_EQ(e.holes, 1);
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{}));
}

TEST(CompareWithTruth, NothingKnownGivesNan) {
  const DisparityErrors nothing = compareWithTruth(row({1.f}), row({kInf}));
  EXPECT_TRUE(std::isnan(nothing.badPercent(0)));
  EXPECT_TRUE(std::isnan(nothing.coveragePercent()));
  const DisparityErrors only_holes = compareWithTruth(row({kNan}), row({1.f}));
  EXPECT_EQ(only_holes.badPercent(3), 100.0);
  EXPECT_TRUE(std::isnan(only_holes.wrongPercent(3)));
  EXPECT_TRUE(std::isnan(only_holes.averageErrorPx()));
}

TEST(CompareWithTruth, RegionOfALargerImageGivesTheSame) {
  std::mt19937 random(7);
  cv::Mat found(40, 60, CV_32F), truth(40, 60, CV_32F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      found.at<float>(y, x) = random() % 9 == 0 ? kNan : static_cast<float>(random() % 1000) / 64;
      truth.at<float>(y, x) = random() % 9 == 0 ? kInf : static_cast<float>(random() % 1000) / 64;
    }
  const cv::Rect inner(3, 5, 31, 17);
  const DisparityErrors region = compareWithTruth(found(inner), truth(inner));
  const DisparityErrors copy = compareWithTruth(found(inner).clone(), truth(inner).clone());
  EXPECT_EQ(region.known, copy.known);
  EXPECT_EQ(region.wrong, copy.wrong);
  EXPECT_EQ(region.error_sum_px, copy.error_sum_px);
  EXPECT_LT(region.known, inner.area());
}

TEST(CompareWithTruth, RefusesOtherSizesAndTypes) {
  const cv::Mat map(4, 5, CV_32F, cv::Scalar(1));
  EXPECT_THROW(compareWithTruth(map, cv::Mat(5, 4, CV_32F)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(map, cv::Mat(4, 5, CV_16S)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(cv::Mat(4, 5, CV_16S), map), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(map, map, cv::Mat(4, 4, CV_8U)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(map, map, cv::Mat(4, 5, CV_32F)), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
