// Disparities on slanted planes: fractions of a pixel spread evenly, errors do not follow them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bench/subpixel/planes.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

// Rendering takes longer than matching.
const std::vector<RenderedPair>& planesOf(const Texture& texture) {
  static std::map<std::string, std::vector<RenderedPair>> known;
  std::vector<RenderedPair>& planes = known[texture.name];
  if (planes.empty())
    for (int tilt = 0; tilt < kTilts; ++tilt) planes.push_back(slantedPlane(texture, tilt));
  return planes;
}

FractionStatistics onPlanes(const Texture& texture, SubpixelMethod method, PlaneMap map) {
  StereoEngine engine(planeOptions(method, map));
  FractionStatistics statistics;
  for (const RenderedPair& pair : planesOf(texture))
    statistics.add(engine.compute(pair.left.image, pair.right.image).disparity, pair.left);
  return statistics;
}

TEST(Stairs, TheFittedCurveHasNone) {
  FractionStatistics all;
  for (const Texture& texture : textures()) {
    const FractionStatistics fitted = onPlanes(texture, SubpixelMethod::kFitted, PlaneMap::kSparse);
    EXPECT_LE(fitted.unevenness(), 0.35) << texture.name;
    EXPECT_LE(fitted.fullest(), 2.0) << texture.name;
    EXPECT_LE(fitted.rmsPx(), 0.12) << texture.name;
    EXPECT_LE(fitted.swingPx(), 0.11) << texture.name;
    all.add(fitted);
  }
  EXPECT_LE(all.unevenness(), 0.16);
  EXPECT_LE(all.rmsPx(), 0.08);
  EXPECT_LE(all.swingPx(), 0.025);
}

TEST(Stairs, WholeDisparitiesAndTheParabolaHave) {
  const Texture& middle = textures()[1];
  const FractionStatistics none = onPlanes(middle, SubpixelMethod::kNone, PlaneMap::kRaw);
  EXPECT_NEAR(none.fullest(), FractionStatistics::kBins, 1e-9);
  const FractionStatistics parabola = onPlanes(middle, SubpixelMethod::kParabola, PlaneMap::kSparse);
  const FractionStatistics fitted = onPlanes(middle, SubpixelMethod::kFitted, PlaneMap::kSparse);
  EXPECT_GE(parabola.unevenness(), 4 * fitted.unevenness());
  EXPECT_GE(parabola.swingPx(), 6 * fitted.swingPx());
  EXPECT_GE(parabola.rmsPx(), 1.4 * fitted.rmsPx());
}

TEST(Stairs, RefinementOfTheDenseMapAddsNone) {
  const Texture& middle = textures()[1];
  const FractionStatistics sparse = onPlanes(middle, SubpixelMethod::kFitted, PlaneMap::kSparse);
  const FractionStatistics dense = onPlanes(middle, SubpixelMethod::kFitted, PlaneMap::kDense);
  EXPECT_LE(dense.unevenness(), sparse.unevenness());
  EXPECT_LE(dense.rmsPx(), sparse.rmsPx());
}

TEST(Stairs, AreCounted) {
  RenderedView left;
  left.disparity = cv::Mat(1, 1000, CV_32F);
  for (int x = 0; x < 1000; ++x) left.disparity.at<float>(0, x) = 5 + 0.01f * static_cast<float>(x) + 0.005f;
  left.mask = cv::Mat(1, 1000, CV_8U, cv::Scalar(255));
  FractionStatistics perfect;
  perfect.add(left.disparity, left);
  EXPECT_NEAR(perfect.unevenness(), 0, 1e-6);
  EXPECT_NEAR(perfect.swingPx(), 0, 1e-6);
  cv::Mat halves = left.disparity.clone();
  for (int x = 0; x < 1000; ++x) halves.at<float>(0, x) = std::floor(2 * halves.at<float>(0, x)) / 2;
  FractionStatistics stairs;
  stairs.add(halves, left);
  stairs.add(halves, left);  // the same again changes no share
  EXPECT_NEAR(stairs.fullest(), 10, 1e-6);
  EXPECT_NEAR(stairs.unevenness(), 3, 1e-6);  // 2 bins at 10, 18 at 0: sqrt((2 * 81 + 18) / 20)
  EXPECT_NEAR(stairs.swingPx(), 0.4, 1e-4);   // -0.05 to -0.45
  left.mask.setTo(128);
  FractionStatistics hidden = perfect;
  hidden.add(halves, left);
  EXPECT_EQ(hidden.unevenness(), perfect.unevenness());
}

}  // namespace
}  // namespace pomona
