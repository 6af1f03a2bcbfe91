// The bench of fruits: its statistics, what it takes for the truth, and the file that keeps measurements.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/fruits/tables.h"
#include "datasets/rendering/named_rigs.h"
#include "file_support.h"

namespace pomona {
namespace {

TEST(DistanceErrors, AreThoseOfTheMeasuredOnes) {
  const std::vector<MeasuredDistance> distances = {
      {1, 1.001, 0.0004}, {2, 1.998, 0.0011}, {1, kNoDistance, kNoDistance}, {0.5, 0.505, kNoDistance}};
  const DistanceErrors e = errorsOf(distances);
  EXPECT_EQ(e.all, 4);
  EXPECT_EQ(e.measured, 3);
  EXPECT_NEAR(e.mean_mm, (1 + 2 + 5) / 3.0, 1e-9);
  EXPECT_NEAR(e.rms_mm, std::sqrt((1 + 4 + 25) / 3.0), 1e-9);
  EXPECT_NEAR(e.median_mm, 2, 1e-9);
  EXPECT_NEAR(e.mean_percent, (0.1 + 0.1 + 1) / 3, 1e-9);
  EXPECT_NEAR(e.median_percent, 0.1, 1e-9);
  EXPECT_NEAR(e.p95_percent, 1, 1e-9);
  EXPECT_EQ(e.within_2_sigma_percent,
            50);  // 1 mm is outside of 0.8, 2 mm inside of 2.2
  const DistanceErrors none = errorsOf({});
  EXPECT_EQ(none.measured, 0);
  EXPECT_TRUE(std::isnan(none.mean_mm));
  EXPECT_TRUE(std::isnan(none.within_2_sigma_percent));
}

TEST(Quantile, IsAnEntry) {
  EXPECT_EQ(quantile({5, 1, 3, 2, 4}, 0.5), 3);
  EXPECT_EQ(quantile({5, 1, 3, 2, 4}, 0), 1);
  EXPECT_EQ(quantile({5, 1, 3, 2, 4}, 0.99), 5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

OrchardPicture smallPicture(std::uint64_t seed) {
  return takePicture(sceneFor(resized(namedRig("seed-003"), 320, 180)), kBands[0], seed, usualEffects(seed));
}

StereoResult mapOfTruth(const OrchardPicture& picture, double factor) {
  StereoResult result;
  result.disparity = picture.pair.left.disparity * factor;
  return result;
}

TEST(MeasureFruits, TheTruthIsRightAndAFactorIsSeen) {
  const OrchardPicture picture = smallPicture(1);
  ASSERT_GE(picture.fruits.size(), 3u);
  const std::vector<WaysOfOneFruit> right = measureFruits(mapOfTruth(picture, 1), picture, 1);
  const std::vector<WaysOfOneFruit> far = measureFruits(mapOfTruth(picture, 1 / 1.02), picture, 1);
  ASSERT_EQ(right.size(), picture.fruits.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_GE(picture.fruits[i].visible_share, kLeastVisible);
    const MeasuredDistance &median = right[i][kMedian], &mask = right[i][kMask], &center = right[i][kCenter];
    EXPECT_EQ(median.measured_m, median.true_m);
    EXPECT_NEAR(far[i][kMedian].measured_m / median.true_m, 1.02, 1e-6);
    EXPECT_NEAR(mask.measured_m / mask.true_m, 1, 0.005);
    EXPECT_NEAR(center.measured_m / center.true_m, 1, 0.02);
    EXPECT_LT(mask.true_m, center.true_m);
    EXPECT_NEAR(far[i][kMask].measured_m / mask.measured_m, 1.02, 0.005);
    EXPECT_TRUE(std::isnan(mask.sigma_m)) << "a map without sigma_px claims nothing";
  }
}

TEST(MeasureFruits, HolesAreNotMeasured) {
  const OrchardPicture picture = smallPicture(1);
  StereoResult holes = mapOfTruth(picture, 1);
  holes.disparity.setTo(std::numeric_limits<float>::quiet_NaN());
  for (const WaysOfOneFruit& fruit : measureFruits(holes, picture, 1))
    for (const MeasuredDistance& d : fruit) EXPECT_TRUE(std::isnan(d.measured_m));
}

TEST(MapOf, ComesWithSigmaFromThePresets) {
  const RenderedPair pair = smallPicture(2).pair;
  const auto map = [&](const char* method) {
    return mapOf(method, pair.left.image, pair.right.image, pair.calibration.num_disparities);
  };
  for (const char* method : {"balanced", "paper", "ssd"}) {
    EXPECT_EQ(map(method).disparity.size(), pair.left.image.size()) << method;
    EXPECT_EQ(map(method).sigma_px.empty(), !knowsSigma(method)) << method;
  }
  EXPECT_THROW(map("magic"), std::invalid_argument);
}

std::vector<FruitMethod> someMethods() {
  FruitMethod balanced{"balanced"}, ssd{"ssd"};
  WaysOfOneFruit ways;
  for (int way = 0; way < kWays; ++way) ways[way] = {0.7, 0.701 + way, 0.001};
  balanced.fruits[0] = {{1001, 2, 0.5, ways}};
  for (MeasuredDistance& way : ways) way.sigma_m = kNoDistance;
  ways[kMask].measured_m = kNoDistance;
  ssd.fruits[2] = {{3001, 1, 0.75, ways}, {3001, 4, 0.31, ways}};
  return {balanced, ssd};
}

TEST(FruitList, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  const std::string path = put(folder / "list.csv", fruitList("seed-003", someMethods()));
  std::vector<FruitMethod> methods = {{"ncc"}, {"ssd"}};
  addFruitList(path, "seed-003", methods);
  ASSERT_EQ(methods.size(), 3u);
  EXPECT_EQ(methods[1].fruits[2].size(), 2u);
  EXPECT_EQ(methods[2].name, "balanced");
  EXPECT_EQ(fruitList("seed-003", {{methods[2], methods[1]}}), bytesOf(path));
  EXPECT_EQ(methods[1].errors(2, kMask).measured, 0);
  EXPECT_EQ(methods[2].errors(0, kMask).measured, 1);

  expectContains(messageOf([&] { addFruitList(path, "seed-003", methods); }),
                 "line 2: a fruit that is counted");
  std::vector<FruitMethod> none;
  expectContains(messageOf([&] { addFruitList(path, "middlebury", none); }), "the rig is 'seed-003'");
  const std::string header = bytesOf(path).substr(0, bytesOf(path).find('\n') + 1);
  for (const char* line : {"seed-003,ssd,0.6,1", "seed-003,ssd,0.6,x,1,1,,,,,,,,,,,,,,,", "nonsense"})
    expectContains(messageOf([&] { addFruitList(put(folder / "bad.csv", header + line), "seed-003", none); }),
                   "bad.csv: line 2: no fruit");
  expectContains(messageOf([&] { addFruitList(put(folder / "bad.csv", "a,b\n"), "seed-003", none); }),
                 "no list of pomona_fruits");
}

TEST(FruitTables, HaveARowForEveryMethodAndBand) {
  const std::string tables = fruitTables(someMethods());
  expectContains(tables, "| 0.6 - 0.75 m | balanced | 1 | 1 | 1.00 | 1.00 | 0.143 | 0.143 | 0.143 | 100 |");
  expectContains(tables, "| 1.6 - 1.9 m | ssd | 2 | 0 | - |");
  expectContains(tables, "| balanced | centre | 0.6 - 0.75 m | 1 | 1 | 3001.00 |");
  EXPECT_EQ(tables.find("| 1 - 1.2 m"), tables.npos) << "nothing was measured there";
}

}  // namespace
}  // namespace pomona
