// The comparison tool itself: what it fills, how it averages, and that its guard bites.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "bench/accuracy/guard.h"
#include "bench/accuracy/opencv_peer.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

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

TEST(MatchWithOpenCv, FindsAShiftOverTheWholeWidth) {
  cv::Mat texture(60, 140, CV_8U);
  cv::RNG(3).fill(texture, cv::RNG::UNIFORM, 0, 256);
  const cv::Mat left = texture.colRange(0, 120), right = texture.colRange(7, 127);  // right(x) = left(x + 7)
  const cv::Mat disparity = matchWithOpenCv(left, right, 16);
  ASSERT_EQ(disparity.size(), left.size());
  ASSERT_EQ(disparity.type(), CV_32F);
  const cv::Mat inner = disparity(cv::Rect(12, 5, 100, 50));
  EXPECT_EQ(cv::countNonZero(cv::abs(inner - 7) <= 0.25), inner.total());
}

// One scene with the given bad-1 and bad-2 (or wrong-1 and wrong-2) for both kinds of maps.
MethodFigures figures(const std::string& name, bool dense, double level, double coverage = 100) {
  SceneFigures scene{"only", {}, {}};
  scene.all.fill(level);
  scene.all[kCoverage] = coverage;
  scene.nonoccluded.fill(std::numeric_limits<double>::quiet_NaN());
  return {name, dense, {scene}};
}

struct Setting {
  std::vector<Method> methods = {{"ours dense", true, true, {}},
                                 {"paper dense", true, false, {}},
                                 {"opencv-hh dense", true, false, {}},
                                 {"ours sparse", false, true, {}},
                                 {"opencv-hh sparse", false, false, {}}};
  std::vector<MethodFigures> found = {
      figures("ours dense", true, 8), figures("paper dense", true, 60), figures("opencv-hh dense", true, 10),
      figures("ours sparse", false, 4, 80), figures("opencv-hh sparse", false, 6, 88)};
  AcceptedFigures accepted{{"only"}, {}};

  Setting() {
    for (const MethodFigures& method : found) accepted.mean[method.method] = method.mean().all;
  }
  std::size_t failures() const { return accuracyFailures(methods, found, accepted).size(); }
};

TEST(AccuracyGuard, PassesWhatIsNoWorse) {
  Setting s;
  EXPECT_EQ(s.failures(), 0u);
  s.found[0] = figures("ours dense", true, 8.1);
  s.found[1] = figures("paper dense", true, 10);
  EXPECT_EQ(s.failures(), 0u);
}

TEST(AccuracyGuard, FailsWhatSlippedAndWhatLosesToThePeer) {
  Setting slipped;
  slipped.found[0] = figures("ours dense", true, 8.2);
  EXPECT_EQ(slipped.failures(), 2u);  // bad-1 and bad-2
  Setting thinner;
  thinner.found[3] = figures("ours sparse", false, 4, 79.8);
  EXPECT_EQ(thinner.failures(), 1u);
  Setting beaten;
  beaten.found[4] = figures("opencv-hh sparse", false, 3.9, 88);
  EXPECT_EQ(beaten.failures(), 2u);
  Setting broken;
  broken.found[1] = figures("paper dense", true, std::nan(""));
  EXPECT_EQ(broken.failures(), 2u);
  Setting other_scenes;
  other_scenes.accepted.scenes = {"only", "another"};
  EXPECT_EQ(other_scenes.failures(), 1u);
  Setting unknown;
  unknown.accepted.mean.erase("ours dense");
  EXPECT_EQ(unknown.failures(), 1u);
}

TEST(AccuracyReport, JsonIsReadBack) {
  Setting s;
  s.found[0].scenes.push_back({"second", {}, {}});  // all figures 0: the mean halves
  const std::string path = ::testing::TempDir() + "accuracy_report.json";
  std::ofstream(path) << json(s.found);
  const AcceptedFigures read = readAccepted(path);
  std::remove(path.c_str());
  EXPECT_EQ(read.scenes, (std::vector<std::string>{"only", "second"}));
  ASSERT_EQ(read.mean.size(), s.found.size());
  EXPECT_EQ(read.mean.at("ours dense")[kBad1], 4);
  EXPECT_EQ(read.mean.at("ours sparse")[kCoverage], 80);
  EXPECT_THROW(readAccepted(path), std::runtime_error);
}

TEST(AccuracyReport, MeansLeaveOutWhatASceneLacks) {
  Figures known, unknown;
  known.fill(3);
  unknown.fill(std::nan(""));
  EXPECT_EQ(meanOf({known, unknown})[kBad2], 3);
  EXPECT_TRUE(std::isnan(meanOf({unknown})[kBad2]));
  EXPECT_NE(markdown({figures("ours dense", true, 8)}).find("| only | 8.00 / 8.00 / 8.00 |"),
            std::string::npos);
}

}  // namespace
}  // namespace pomona
