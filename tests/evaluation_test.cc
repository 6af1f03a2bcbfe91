// Every measure against cases small enough to count by hand. metrics.py repeats them on whole scenes.
#include "pomona/evaluation.h"

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
cv::Mat bytes(std::vector<std::uint8_t> values) {
  return cv::Mat(values, true).reshape(1, 1);
}

TEST(CompareWithTruth, CountsByHand) {
  //                             exact   on .5   over .5  over 1   hole   hole   unknown  unknown  over 4
  const cv::Mat truth = row({/**/ 10.f, 10.00f, 10.000f, 10.00f, 10.f, 10.00f, kInf, kNan, 10.f});
  const cv::Mat found = row({/**/ 10.f, 10.50f, 10.625f, 11.25f, kNan, kInf, 10.f, kNan, 15.f});
  const DisparityErrors e = compareWithTruth(found, truth);
  EXPECT_EQ(e.known, 7);
  EXPECT_EQ(e.holes, 2);
  EXPECT_EQ(e.found(), 5);
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{3, 2, 1, 1}));
  EXPECT_DOUBLE_EQ(e.error_sum_px, 0.5 + 0.625 + 1.25 + 5);
  EXPECT_DOUBLE_EQ(e.badPercent(0), 100.0 * 5 / 7);
  EXPECT_DOUBLE_EQ(e.badPercent(1), 100.0 * 4 / 7);
  EXPECT_DOUBLE_EQ(e.wrongOfKnownPercent(1), 100.0 * 2 / 7);
  EXPECT_DOUBLE_EQ(e.wrongPercent(2), 100.0 * 1 / 5);
  EXPECT_DOUBLE_EQ(e.invalidPercent(), 100.0 * 2 / 7);
  EXPECT_DOUBLE_EQ(e.coveragePercent(), 100.0 * 5 / 7);
  EXPECT_DOUBLE_EQ(e.averageErrorPx(), 7.375 / 5);
  EXPECT_DOUBLE_EQ(e.rmsErrorPx(), std::sqrt((0.25 + 0.390625 + 1.5625 + 25) / 5));
}

TEST(CompareWithTruth, AnErrorOfExactlyTheThresholdIsNotBad) {
  const DisparityErrors e = compareWithTruth(row({9.5f, 11.f, 8.f, 14.f}), row({10.f, 10.f, 10.f, 10.f}));
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{3, 2, 1, 0}));
}

TEST(CompareWithTruth, QuantilesAreEntriesOfTheSortedErrors) {
  std::vector<float> found(201, kNan);
  for (int i = 0; i < 200; ++i)
    found[static_cast<std::size_t>((i * 77) % 200)] = static_cast<float>(i);  // shuffled
  const std::vector<float> zero(201, 0.f);
  EXPECT_EQ(compareWithTruth(row(found), row(zero)).quantile_px, (std::array<float, 4>{100, 180, 190, 198}));
  EXPECT_EQ(compareWithTruth(row({3.f}), row({1.f})).quantile_px, (std::array<float, 4>{2, 2, 2, 2}));
}

TEST(CompareWithTruth, TheMaskLeavesOnly255) {
  const DisparityErrors e =
      compareWithTruth(row({1, 9, 9, kNan, 9}), row({1, 1, 1, 1, 1}), bytes({255, 128, 0, 255, 254}));
  EXPECT_EQ(e.known, 2);
  EXPECT_EQ(e.holes, 1);
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{}));
}

TEST(CompareWithTruth, ALargerTruthMeetsTheCoveringPixelTimesTheRatio) {
  cv::Mat truth(4, 8, CV_32F, cv::Scalar(20)), map(2, 4, CV_32F, cv::Scalar(10));
  EXPECT_EQ(compareWithTruth(map, truth).error_sum_px, 0);
  map.at<float>(1, 2) = 10.75f;  // covers 2x2 pixels of the truth, off by 1.5 of its pixels
  truth.at<float>(3, 5) = kInf;
  const DisparityErrors e = compareWithTruth(map, truth);
  EXPECT_EQ(e.known, 31);
  EXPECT_EQ(e.wrong, (std::array<std::int64_t, 4>{3, 3, 0, 0}));

  const cv::Mat quarter(1, 2, CV_32F, cv::Scalar(5));
  EXPECT_EQ(compareWithTruth(quarter, cv::Mat(4, 8, CV_32F, cv::Scalar(20))).error_sum_px, 0);
  EXPECT_THROW(compareWithTruth(quarter, cv::Mat(3, 6, CV_32F)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(quarter, cv::Mat(8, 16, CV_32F)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(quarter, cv::Mat(4, 9, CV_32F)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(quarter, cv::Mat(2, 8, CV_32F)), std::invalid_argument);
  EXPECT_THROW(compareWithTruth(map, truth, cv::Mat(2, 4, CV_8U)), std::invalid_argument);
}

TEST(CompareWithTruth, MiddleburyClipsKnownDisparities) {
  const cv::Mat truth = row({0, 64, 60, 5}), found = row({-3, 80, 63, kInf});
  const DisparityErrors e = compareWithTruth(found, truth, {}, EvaluationRules::middlebury(64));
  EXPECT_EQ(e.error_sum_px, 3);
  EXPECT_EQ(e.holes, 1);
  EXPECT_EQ(compareWithTruth(found, truth).error_sum_px, 3 + 16 + 3);
  // The limit is in pixels of the map: 2 * 30 at twice the size.
  const cv::Mat half(1, 2, CV_32F, cv::Scalar(40));
  EXPECT_EQ(compareWithTruth(half, cv::Mat(2, 4, CV_32F, cv::Scalar(60)), {}, EvaluationRules::middlebury(30))
                .error_sum_px,
            0);
}

TEST(CompareWithTruth, WholeTruthsAreComparedWithWholePixels) {
  EvaluationRules rules;
  rules.round = true;
  EXPECT_EQ(compareWithTruth(row({4.4f, 4.6f}), row({4, 4}), {}, rules).error_sum_px, 1);
}

TEST(CompareWithTruth, Eth3dTakesDisparitiesBeyondTheWidthForHoles) {
  const DisparityErrors e =
      compareWithTruth(row({5, 5.5f, -5, -6}), row({1, 1, 1, 1}), {}, EvaluationRules::eth3d(5));
  EXPECT_EQ(e.holes, 2);
  EXPECT_EQ(e.error_sum_px, 4 + 6);
}

TEST(CompareWithTruth, NothingKnownGivesNan) {
  const DisparityErrors nothing = compareWithTruth(row({1.f}), row({kInf}));
  EXPECT_TRUE(std::isnan(nothing.badPercent(0)));
  EXPECT_TRUE(std::isnan(nothing.coveragePercent()));
  EXPECT_TRUE(std::isnan(nothing.quantile_px[0]));
  const DisparityErrors only_holes = compareWithTruth(row({kNan}), row({1.f}));
  EXPECT_EQ(only_holes.badPercent(3), 100.0);
  EXPECT_TRUE(std::isnan(only_holes.wrongPercent(3)));
  EXPECT_TRUE(std::isnan(only_holes.averageErrorPx()));
  EXPECT_TRUE(std::isnan(only_holes.rmsErrorPx()));
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

TEST(KittiErrors, AnOutlierIsOffByMoreThanThreePixelsAndFivePercent) {
  //                           on 3   over 3  5 % of 80  over 5 %  3.5 of 100  hole   unknown
  const cv::Mat truth = row({/**/ 10, 10, /*****/ 80, /***/ 80, /***/ 100, /****/ 10, kNan});
  const cv::Mat found = row({/**/ 13, 13.25f, /**/ 84, /**/ 84.25f, 103.5f, /**/ kNan, 10});
  const KittiErrors e = kittiErrors(found, truth, bytes({0, 0, 0, 7, 0, 1, 1}));
  EXPECT_EQ(e.background.known, 4);
  EXPECT_EQ(e.background.outliers, 1);
  EXPECT_EQ(e.foreground.known, 2);
  EXPECT_EQ(e.foreground.outliers, 1);
  EXPECT_EQ(e.foreground.holes, 1);
  EXPECT_EQ(e.background.d1Percent(), 25);
  EXPECT_EQ(e.foreground.d1Percent(), 100);
  EXPECT_EQ(e.foreground.outlierPercent(), 100);
  EXPECT_DOUBLE_EQ(e.all().d1Percent(), 50);
  EXPECT_DOUBLE_EQ(e.all().outlierPercent(), 40);

  const KittiErrors seen_by_both =
      kittiErrors(found, truth, bytes({0, 0, 0, 7, 0, 1, 1}), bytes({255, 128, 255, 255, 255, 128, 255}));
  EXPECT_EQ(seen_by_both.background.known, 3);
  EXPECT_EQ(seen_by_both.background.outliers, 0);
  EXPECT_EQ(seen_by_both.foreground.known, 1);
  EXPECT_EQ(seen_by_both.all().d1Percent(), 25);

  const KittiErrors without_objects = kittiErrors(found, truth);
  EXPECT_EQ(without_objects.background.known, 6);
  EXPECT_TRUE(std::isnan(without_objects.foreground.d1Percent()));
  EXPECT_THROW(kittiErrors(found, truth, bytes({0})), std::invalid_argument);
  EXPECT_THROW(kittiErrors(found, truth, {}, bytes({0})), std::invalid_argument);
}

std::vector<float> filled(int rows, std::vector<float> values) {
  cv::Mat map = cv::Mat(values).reshape(1, rows);  // on the memory of `values`
  fillRowsFromBackground(map);
  return values;
}

TEST(FillRowsFromBackground, TakesTheFartherSide) {
  EXPECT_EQ(filled(1, {kNan, 5, kNan, kNan, 3, kNan, 9, kNan}), (std::vector<float>{5, 5, 3, 3, 3, 3, 9, 9}));
}

TEST(FillRowsFromBackground, EmptyRowsTakeTheRowAboveElseTheFirstBelow) {
  EXPECT_EQ(filled(5, {kNan, kNan, kNan, kNan, 1, kNan, kNan, kNan, 2, 2}),
            (std::vector<float>{1, 1, 1, 1, 1, 1, 1, 1, 2, 2}));
}

TEST(Summary, TimesAndMeans) {
  EXPECT_DOUBLE_EQ(secondsPerMegapixel(3, {2000, 1500}), 1);
  EXPECT_DOUBLE_EQ(secondsPerGigadisparity(3, {2000, 1500}, 100), 10);
  const std::vector<double> values = {1, std::nan(""), 4}, weights = {1, 5, 0.5};
  EXPECT_DOUBLE_EQ(weightedMean(values), 2.5);
  EXPECT_DOUBLE_EQ(weightedMean(values, weights), 2);
  EXPECT_TRUE(std::isnan(weightedMean({})));
  EXPECT_THROW(weightedMean(values, std::vector<double>{1, 2}), std::invalid_argument);
  EXPECT_EQ(middleburyWeight("Shelves"), 0.5);
  EXPECT_EQ(middleburyWeight("Teddy"), 1);
  EXPECT_EQ(middleburyWeight("MiddEval3/trainingQ/Vintage"), 0.5);
  EXPECT_EQ(middleburyWeight("Vintage/Teddy"), 1);
}

TEST(CoverageCurve, FollowsTheConfidence) {
  // In the order of confidence: right, wrong, right, right; a hole; one unknown.
  const cv::Mat truth = row({9, 9, 9, 9, 9, kInf}), found = row({9, 20, 9, 9, kNan, 9});
  const cv::Mat confidence = row({.9f, .8f, .5f, .1f, 1, 1});
  const CoverageCurve curve = coverageCurve(found, confidence, truth, {}, 1, 4);
  ASSERT_EQ(curve.points.size(), 4u);
  const double coverage[] = {20, 40, 60, 80}, wrong[] = {0, 50, 100.0 / 3, 25}, oracle[] = {0, 0, 0, 25};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(curve.points[i].coverage_percent, coverage[i]);
    EXPECT_DOUBLE_EQ(curve.points[i].wrong_percent, wrong[i]);
    EXPECT_DOUBLE_EQ(curve.points[i].oracle_percent, oracle[i]);
  }
  EXPECT_DOUBLE_EQ(curve.area_percent, (0 + 50 + 100.0 / 3 + 25) / 4);
  EXPECT_DOUBLE_EQ(curve.oracle_area_percent, 25.0 / 4);
  EXPECT_DOUBLE_EQ(curve.excessAreaPercent(), curve.area_percent - 25.0 / 4);
  EXPECT_EQ(coverageCurve(found, confidence, truth, {}, 11).area_percent, 0);  // nothing is off by more
}

TEST(CoverageCurve, EqualConfidencesKnowNothing) {
  const cv::Mat truth = row({9, 9, 9, 9}), found = row({20, 9, 20, 9}), same(1, 4, CV_32F, cv::Scalar(.5));
  for (const CoverageCurve::Point& point : coverageCurve(found, same, truth).points)
    EXPECT_DOUBLE_EQ(point.wrong_percent, 50);
  // A confidence that is not a number is the least.
  const CoverageCurve curve = coverageCurve(found, row({kNan, 1, kNan, 0}), truth, {}, 1, 2);
  EXPECT_EQ(curve.points[0].wrong_percent, 0);
  EXPECT_EQ(curve.excessAreaPercent(), 0);
}

TEST(CoverageCurve, HasNoPointsWithoutPixels) {
  const CoverageCurve curve = coverageCurve(row({kNan}), row({1}), row({3}));
  EXPECT_TRUE(curve.points.empty());
  EXPECT_TRUE(std::isnan(curve.area_percent));
  EXPECT_THROW(coverageCurve(row({1}), row({1}), row({3}), {}, 1, 0), std::invalid_argument);
  EXPECT_THROW(coverageCurve(row({1}), row({1, 2}), row({3})), std::invalid_argument);
}

TEST(SubpixelErrors, SortsInliersByTheFractionOfTheTruth) {
  const cv::Mat truth = row({4, 4.25f, 4.5f, 4.75f, -0.25f, 4.25f, 4.25f});
  const cv::Mat found = row({4, 4.125f, 4.5f, 5, -.5f, 6, kNan});
  const SubpixelErrors e = subpixelErrors(found, truth, {}, 4);
  ASSERT_EQ(e.bins.size(), 4u);
  EXPECT_EQ(e.bins[0].count, 1);
  EXPECT_EQ(e.bins[1].count, 1);
  EXPECT_EQ(e.bins[1].biasPx(), -0.125);
  EXPECT_EQ(e.bins[1].rmsPx(), 0.125);
  EXPECT_EQ(e.bins[3].count, 2);  // 4.75 and -0.25
  EXPECT_EQ(e.bins[3].biasPx(), 0);
  EXPECT_EQ(e.bins[3].rmsPx(), 0.25);
  EXPECT_EQ(e.all.count, 5);
  EXPECT_DOUBLE_EQ(e.all.biasPx(), -0.025);
  EXPECT_EQ(subpixelErrors(row({5}), row({4})).all.count, 1);  // off by exactly the limit: an inlier
  EXPECT_TRUE(std::isnan(subpixelErrors(row({9}), row({4})).all.rmsPx()));
  EXPECT_THROW(subpixelErrors(found, truth, {}, 0), std::invalid_argument);
}

TEST(SigmaCalibration, CountsErrorsWithinOneTwoAndThreeSigma) {
  const cv::Mat truth = row({10, 10, 10, 10, 10, 10, 10}), found = row({11, 12, 13, 14, kNan, 10, 10});
  const cv::Mat sigma = row({1, 1, 1, 1, 1, kNan, -1});
  const SigmaCalibration c = sigmaCalibration(found, sigma, truth);
  EXPECT_EQ(c.count, 4);
  EXPECT_EQ(c.withinPercent(1), 25);
  EXPECT_EQ(c.withinPercent(2), 50);
  EXPECT_EQ(c.withinPercent(3), 75);
  EXPECT_TRUE(std::isnan(sigmaCalibration(row({kNan}), row({1}), row({1})).withinPercent(1)));
  EXPECT_THROW(sigmaCalibration(found, row({1}), truth), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
