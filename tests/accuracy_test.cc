// The comparison tool itself: how it averages, and that its guard bites.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "bench/accuracy/guard.h"

namespace pomona {
namespace {

// One scene with the given bad-1 and bad-2 (or wrong-1 and wrong-2) for both kinds of maps.
MethodFigures figures(const std::string& name, MapKind kind, double level, double coverage = 100) {
  SceneFigures scene{"only", {}, {}};
  scene.all.fill(level);
  scene.all[kCoverage] = coverage;
  scene.nonoccluded.fill(std::numeric_limits<double>::quiet_NaN());
  return {name, kind, {scene}};
}

struct Setting {
  std::vector<Contender> compared = {
      {"ours", MapKind::kDense, true},        {"paper", MapKind::kDense, false},
      {"opencv-hh", MapKind::kDense, false},  {"ours", MapKind::kSparse, true},
      {"opencv-hh", MapKind::kSparse, false}, {"opencv-hh4", MapKind::kDense, false}};
  std::vector<MethodFigures> found = {figures("ours dense", MapKind::kDense, 8),
                                      figures("paper dense", MapKind::kDense, 60),
                                      figures("opencv-hh dense", MapKind::kDense, 10),
                                      figures("ours sparse", MapKind::kSparse, 4, 80),
                                      figures("opencv-hh sparse", MapKind::kSparse, 6, 88),
                                      figures("opencv-hh4 dense", MapKind::kDense, 1)};
  std::vector<MethodFigures> accepted = found;

  std::size_t failures() const { return accuracyFailures(compared, found, accepted).size(); }
};

TEST(AccuracyGuard, PassesWhatIsNoWorse) {
  Setting s;
  EXPECT_EQ(s.failures(), 0u);
  s.found[0] = figures("ours dense", MapKind::kDense, 8.1);
  s.found[1] = figures("paper dense", MapKind::kDense, 10);
  EXPECT_EQ(s.failures(), 0u);
}

TEST(AccuracyGuard, HoldsSomeScenesAgainstThoseAlone) {
  Setting s;
  Figures bad;
  bad.fill(99);
  s.accepted[0].scenes.push_back({"another", bad, bad});  // would lift the accepted mean
  EXPECT_EQ(s.failures(), 0u);
  s.found[0] = figures("ours dense", MapKind::kDense, 8.2);
  EXPECT_EQ(s.failures(), 2u);
}

TEST(AccuracyGuard, FailsWhatSlippedAndWhatLosesToThePeer) {
  Setting slipped;
  slipped.found[0] = figures("ours dense", MapKind::kDense, 8.2);
  EXPECT_EQ(slipped.failures(), 2u);  // bad-1 and bad-2
  Setting thinner;
  thinner.found[3] = figures("ours sparse", MapKind::kSparse, 4, 79.8);
  EXPECT_EQ(thinner.failures(), 1u);
  Setting beaten;
  beaten.found[4] = figures("opencv-hh sparse", MapKind::kSparse, 3.9, 88);
  EXPECT_EQ(beaten.failures(), 2u);
  Setting broken;
  broken.found[1] = figures("paper dense", MapKind::kDense, std::nan(""));
  EXPECT_EQ(broken.failures(), 2u);
  Setting unknown_scene;
  unknown_scene.found[0].scenes.push_back({"another", {}, {}});
  EXPECT_EQ(unknown_scene.failures(), 1u);
  Setting unknown;
  unknown.accepted.erase(unknown.accepted.begin());
  EXPECT_EQ(unknown.failures(), 1u);
}

TEST(AccuracyGuard, FailsWhatSlippedWhereBothCamerasSeeOnly) {
  Setting s;
  for (auto* figures : {&s.found, &s.accepted})
    (*figures)[0].scenes[0].nonoccluded = (*figures)[0].scenes[0].all;
  EXPECT_EQ(s.failures(), 0u);
  s.found[0].scenes[0].nonoccluded[kBad1] += 0.2;
  EXPECT_EQ(s.failures(), 1u);
  s.found[0].scenes[0].nonoccluded = noFigures();
  EXPECT_EQ(s.failures(), 3u);
}

TEST(AccuracyGuard, LeavesOutWhatRanOnNoScene) {
  Setting s;
  s.found[1].scenes.clear();
  EXPECT_EQ(s.failures(), 0u);
  EXPECT_TRUE(isGuardedOn("asw", "cones"));
  EXPECT_FALSE(isGuardedOn("asw", "Aloe-full"));
  EXPECT_TRUE(isGuardedOn("ncc", "Aloe-full"));
}

TEST(AccuracyReport, JsonIsReadBack) {
  Setting s;
  s.found[0].scenes.push_back({"a \"second\"", {}, {}});  // all figures 0: the mean halves
  s.found[3].scenes[0].all[kBad2] = 1.234567;
  const std::string path = ::testing::TempDir() + "accuracy_report.json";
  std::ofstream(path) << json(s.found);
  const std::vector<MethodFigures> read = readFigures(path);
  std::remove(path.c_str());
  ASSERT_EQ(read.size(), s.found.size());
  EXPECT_EQ(read[0].method, "ours dense");
  EXPECT_EQ(read[3].kind, MapKind::kSparse);
  ASSERT_EQ(read[0].scenes.size(), 2u);
  EXPECT_EQ(read[0].scenes[1].scene, "a \"second\"");
  EXPECT_EQ(read[3].scenes[0].all[kBad2], 1.234567);  // not what the tables show
  EXPECT_EQ(read[0].mean().all[kBad1], 4);
  EXPECT_EQ(read[3].scenes[0].all[kCoverage], 80);
  EXPECT_TRUE(std::isnan(read[3].scenes[0].nonoccluded[kCoverage]));
  EXPECT_THROW(readFigures(path), std::runtime_error);
}

TEST(AccuracyReport, MeansLeaveOutWhatASceneLacks) {
  Figures known, unknown;
  known.fill(3);
  unknown.fill(std::nan(""));
  EXPECT_EQ(meanOf({known, unknown})[kBad2], 3);
  EXPECT_TRUE(std::isnan(meanOf({unknown})[kBad2]));
  const MethodFigures ours = figures("ours dense", MapKind::kDense, 8);
  MethodFigures nowhere = ours;
  nowhere.scenes.clear();
  EXPECT_NE(markdown({ours, nowhere}).find("| only | 8.00 / 8.00 / 8.00 | - |"), std::string::npos);
}

}  // namespace
}  // namespace pomona
