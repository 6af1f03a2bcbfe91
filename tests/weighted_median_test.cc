#include "filters/weighted_median.h"

#include <limits>
#include <stdexcept>
#include <vector>

#include "core/cpu.h"
#include "filters_testing.h"
#include "reference/refine.h"

namespace pomona {
namespace {

using testing::Framed;
using testing::Guide;
using testing::kUnknown;
using testing::Map;
using testing::sameBits;

// Weights are good to 1e-5: so is each share of their sum.
constexpr double kTolerance = 1e-5;

Map<float> run(const Map<float>& in, GuideView guide, Isa isa, int threads, int margin = 0,
               bool in_place = false) {
  static Arena scratch;  // kept from size to size, as an engine does
  Framed<float> from(in, margin, 55.0f);
  Framed<float> to(Map<float>(in.width, in.height, 77.0f), margin, 77.0f);
  Framed<float>& out = in_place ? from : to;
  weightedMedian(from.view(), guide, out.view(), scratch, filterKernels(isa), threads);
  EXPECT_TRUE(to.frameIsIntact() && from.frameIsIntact());
  return out.map();
}

void expectWeightedMedians(const Map<float>& in, GuideView guide, const Map<float>& out) {
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      const float before = in.at(y, x), after = out.at(y, x);
      SCOPED_TRACE(::testing::Message()
                   << "row " << y << " column " << x << ": " << before << " to " << after);
      ASSERT_EQ(std::isnan(before), std::isnan(after));
      if (std::isnan(before)) continue;
      if (!reference::isNearJump(in, y, x, 1.0f)) {
        ASSERT_EQ(before, after);
        continue;
      }
      const reference::WeightShare share = reference::weightShare(in, guide, y, x, after);
      ASSERT_LT(share.below, share.up_to) << "not a value of the window";
      ASSERT_LE(share.below, 0.5 + kTolerance);
      ASSERT_GE(share.up_to, 0.5 - kTolerance);
    }
}

/// A weighted median wherever there should be one, and the same bytes however it is computed.
void expectTwin(const Map<float>& in, GuideView guide) {
  SCOPED_TRACE(::testing::Message() << in.width << 'x' << in.height << " channels " << guide.channels);
  const Map<float> scalar = run(in, guide, Isa::kScalar, 1);
  expectWeightedMedians(in, guide, scalar);
  for (Isa isa : usableIsas())
    for (int threads : testing::kThreadCounts)
      for (int margin : {0, 3})
        ASSERT_TRUE(sameBits(run(in, guide, isa, threads, margin, margin == 3), scalar))
            << "isa " << name(isa) << " threads " << threads << " margin " << margin;
}

TEST(WeightedMedian, HalvesTheWeightForAnyShareOfUnknownPixels) {
  for (int width : testing::kWidths)
    for (int height : {1, 2, 29})
      for (int channels : {1, 3})
        for (double unknown : {0.0, 0.1, 0.6})
          expectTwin(testing::randomDisparity(width, height, unknown, 7u * width + height),
                     Guide(width, height, channels, 3u * width + channels).view);
}

TEST(WeightedMedian, RowsOfAnyLength) {
  const int width = 2500;  // more columns than a kernel call takes
  expectTwin(testing::randomDisparity(width, 5, 0.1, 3), Guide(width, 5, 3, 4).view);
}

TEST(WeightedMedian, ExtremeFills) {
  const Guide guide(35, 9, 3, 1);
  const float largest = std::numeric_limits<float>::max();
  for (float fill : {kUnknown, 0.0f, -3.25f, largest, -largest}) {
    Map<float> map(35, 9, fill);
    expectTwin(map, guide.view);
    map.at(3, 17) = 1.0f;
    expectTwin(map, guide.view);
  }
  Map<float> opposed(35, 9, largest);
  for (int i = 0; i < 35 * 9; i += 2) opposed.pixels[i] = -largest;
  expectTwin(opposed, guide.view);
}

TEST(WeightedMedian, GuidesOfExtremeContrast) {
  std::vector<std::uint8_t> bytes(40 * 30 * 3);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = (i / 3) % 7 < 3 ? 255 : 0;
  expectTwin(testing::randomDisparity(40, 30, 0.1, 5), {bytes.data(), 40, 30, 3, 120});
}

TEST(WeightedMedian, MovesAJumpToTheEdgeOfTheGuide) {
  const int edge = 20;
  std::vector<std::uint8_t> gray(41 * 15);
  Map<float> fattened(41, 15, 3.0f), truth(41, 15, 3.0f);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 41; ++x) {
      gray[y * 41 + x] = x < edge ? 40 : 160;
      if (x < edge) truth.at(y, x) = 12.0f;
      if (x < edge + (y % 3 == 0 ? 1 : 0)) fattened.at(y, x) = 12.0f;
    }
  for (Isa isa : usableIsas())
    EXPECT_TRUE(sameBits(run(fattened, {gray.data(), 41, 15, 1, 41}, isa, 1), truth)) << name(isa);
}

TEST(WeightedMedian, AGrayGuideCountsAsThreeEqualChannels) {
  const Map<float> map = testing::randomDisparity(65, 20, 0.1, 8);
  const Guide gray(65, 20, 1, 2);
  std::vector<std::uint8_t> tripled;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 65; ++x) tripled.insert(tripled.end(), 3, gray.view.row(y)[x]);
  for (Isa isa : usableIsas())
    EXPECT_TRUE(sameBits(run(map, gray.view, isa, 1), run(map, {tripled.data(), 65, 20, 3, 195}, isa, 1)))
        << name(isa);
}

TEST(WeightedMedian, RefusesOtherGuides) {
  const std::vector<std::uint8_t> bytes(8 * 8 * 4, 0);
  for (int channels : {0, 2, 4})
    EXPECT_THROW(run(Map<float>(8, 8, 1.0f), {bytes.data(), 8, 8, channels, 32}, Isa::kScalar, 1),
                 std::invalid_argument)
        << channels;
}

}  // namespace
}  // namespace pomona
