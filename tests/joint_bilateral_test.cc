#include "filters/joint_bilateral.h"

#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/cpu.h"
#include "filters_testing.h"

namespace pomona {
namespace {

using testing::Framed;
using testing::Guide;
using testing::kUnknown;
using testing::Map;
using testing::sameBits;

// Weights are good to 1e-5 and a float rounds to 6e-8: the mean of values up to `range` apart is as good.
constexpr double kTolerance = 1e-5;

Map<float> twin(const Map<float>& in, GuideView guide, const BilateralParameters& p, BilateralTarget target) {
  return reference::jointBilateral(in, guide, p.sigma_space_px, p.sigma_range,
                                   target == BilateralTarget::kHolesOnly, kMinimumBilateralWeight);
}

Map<float> twinOfCompletion(const Map<float>& in, GuideView guide, const BilateralParameters& p) {
  Map<float> map = twin(in, guide, p, p.target);
  for (;;) {
    const Map<float> next = twin(map, guide, p, BilateralTarget::kHolesOnly);
    if (sameBits(next, map)) return map;
    map = next;
  }
}

using FilterFunction = decltype(&jointBilateral);

Map<float> run(FilterFunction filter, const Map<float>& in, GuideView guide, const BilateralParameters& p,
               Isa isa, int threads, int margin = 0) {
  static Arena scratch;  // kept from size to size, as an engine does
  Framed<float> from(in, margin, 55.0f);
  Framed<float> to(Map<float>(in.width, in.height, 77.0f), margin, 77.0f);
  filter(from.view(), guide, p, to.view(), scratch, filterKernels(isa), threads);
  EXPECT_TRUE(to.frameIsIntact());
  return to.map();
}

void expectNear(const Map<float>& actual, const Map<float>& expected, double range) {
  for (int y = 0; y < actual.height; ++y)
    for (int x = 0; x < actual.width; ++x) {
      const float a = actual.at(y, x), e = expected.at(y, x);
      ASSERT_EQ(std::isnan(a), std::isnan(e)) << "row " << y << " column " << x;
      if (std::isnan(e)) continue;
      ASSERT_NEAR(a, e, kTolerance * range) << "row " << y << " column " << x;
    }
}

/// Near the twin, and the same bytes for every instruction set, thread count and stride.
void expectTwin(FilterFunction filter, const Map<float>& in, GuideView guide, const BilateralParameters& p,
                const Map<float>& expected) {
  SCOPED_TRACE(::testing::Message() << in.width << 'x' << in.height << " channels " << guide.channels
                                    << " sigma_s " << p.sigma_space_px << " sigma_r " << p.sigma_range
                                    << " target " << static_cast<int>(p.target));
  const Map<float> scalar = run(filter, in, guide, p, Isa::kScalar, 1);
  double range = 0;
  for (float d : in.pixels)
    if (!std::isnan(d)) range = std::max(range, std::abs(double{d}));
  expectNear(scalar, expected, range);
  for (Isa isa : usableIsas())
    for (int threads : testing::kThreadCounts)
      for (int margin : {0, 3})
        ASSERT_TRUE(sameBits(run(filter, in, guide, p, isa, threads, margin), scalar))
            << name(isa) << " threads " << threads << " margin " << margin;
}

TEST(JointBilateral, IsNearItsTwin) {
  for (int width : testing::kWidths)
    for (int height : {1, 21})
      for (int channels : {1, 3})
        for (double unknown : {0.0, 0.6}) {
          const Map<float> in = testing::randomDisparity(width, height, unknown, 3u * width + height);
          const Guide guide(width, height, channels, 5u * width + height);
          for (BilateralTarget target : {BilateralTarget::kEveryPixel, BilateralTarget::kHolesOnly})
            for (const auto& [sigma_space, sigma_range] : {std::pair{0.4f, 12.0f}, {2.6f, 30.0f}}) {
              const BilateralParameters p{sigma_space, sigma_range, target};
              expectTwin(jointBilateral, in, guide.view, p, twin(in, guide.view, p, target));
            }
        }
}

TEST(JointBilateral, IsNearItsTwinAtTheDefaultSigmas) {
  const Map<float> in = testing::randomDisparity(70, 50, 0.4, 1);
  const Guide guide(70, 50, 1, 2);
  const BilateralParameters p;
  expectTwin(jointBilateral, in, guide.view, p, twin(in, guide.view, p, p.target));
}

TEST(JointBilateral, IsNearItsTwinOnExtremeFills) {
  const Guide guide(33, 9, 1, 3);
  for (float fill : {kUnknown, 0.0f, -7.5f, 1e6f}) {
    const Map<float> in(33, 9, fill);
    const BilateralParameters p{2.0f, 3.0f, BilateralTarget::kEveryPixel};
    expectTwin(jointBilateral, in, guide.view, p, twin(in, guide.view, p, p.target));
  }
}

// A hole between two known pixels, one of its own grey level and one `difference` away: the mean gives away
// the ratio of the two weights, hence the exponential, over its whole range.
TEST(JointBilateral, WeightsAreExactToTheStatedError) {
  for (Isa isa : usableIsas())
    for (float sigma_range : {5.0f, 30.0f, 100.0f})
      for (int difference = 0; difference < 256; ++difference) {
        const double exact = std::exp(-difference * difference / (2.0 * sigma_range * sigma_range));
        if (exact < 1e-30) continue;  // 2^-100: weights below are not promised
        Map<float> in(3, 1, kUnknown);
        in.at(0, 0) = 0.0f;
        in.at(0, 2) = 1.0f;
        const std::uint8_t bytes[] = {0, 0, static_cast<std::uint8_t>(difference)};
        const BilateralParameters p{1.0f, sigma_range, BilateralTarget::kHolesOnly};
        const float mean = run(jointBilateral, in, {bytes, 3, 1, 1, 3}, p, isa, 1).at(0, 1);
        ASSERT_NEAR(mean / (exact / (1 + exact)), 1.0, 1e-5)
            << name(isa) << " sigma_r " << sigma_range << " difference " << difference;
      }
}

TEST(JointBilateral, AConstantMapStaysConstant) {
  const Guide guide(60, 45, 3, 4);
  const Map<float> in(60, 45, 101.3f);
  const Map<float> out = run(jointBilateral, in, guide.view, {}, usableIsas().back(), 1);
  for (float d : out.pixels) ASSERT_NEAR(d, 101.3f, 101.3f * 2e-6f);
}

TEST(JointBilateral, MayWorkInPlace) {
  const Map<float> in = testing::randomDisparity(65, 20, 0.5, 9);
  const Guide guide(65, 20, 1, 9);
  for (BilateralTarget target : {BilateralTarget::kEveryPixel, BilateralTarget::kHolesOnly}) {
    const BilateralParameters p{2.0f, 20.0f, target};
    Arena scratch;
    Framed<float> map(in, 2, 1.0f);
    jointBilateral(map.view(), guide.view, p, map.view(), scratch, filterKernels(usableIsas().back()), 3);
    EXPECT_TRUE(sameBits(map.map(), run(jointBilateral, in, guide.view, p, Isa::kScalar, 1)));
  }
}

TEST(JointBilateral, DoesNotCrossAStrongEdge) {
  std::vector<std::uint8_t> bytes(40 * 10, 0);
  Map<float> in(40, 10, 10.0f);
  for (int y = 0; y < 10; ++y)
    for (int x = 20; x < 40; ++x) bytes[y * 40 + x] = 255, in.at(y, x) = 50.0f;
  for (int y = 0; y < 10; ++y)
    for (int x = 17; x < 23; ++x) in.at(y, x) = kUnknown;
  const Map<float> out = run(jointBilateral, in, {bytes.data(), 40, 10, 1, 40}, {}, usableIsas().back(), 1);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 40; ++x) EXPECT_NEAR(out.at(y, x), x < 20 ? 10.0f : 50.0f, 1e-3f);
}

TEST(CompleteByBilateral, EqualsRepeatedPassesOfTheTwin) {
  for (BilateralTarget target : {BilateralTarget::kEveryPixel, BilateralTarget::kHolesOnly})
    for (int width : {17, 50}) {
      Map<float> in = testing::randomDisparity(width, 24, 0.2, 11);
      for (int y = 0; y < 24; ++y)  // a hole much deeper than the window, open to one side
        for (int x = 0; x < 2 * width / 3; ++x) in.at(y, x) = kUnknown;
      const Guide guide(width, 24, 3, 12);
      const BilateralParameters p{1.3f, 30.0f, target};
      const Map<float> expected = twinOfCompletion(in, guide.view, p);
      for (float d : expected.pixels) ASSERT_FALSE(std::isnan(d));
      expectTwin(completeByBilateral, in, guide.view, p, expected);
    }
}

TEST(CompleteByBilateral, GrowsFromASinglePixel) {
  Map<float> in(70, 25, kUnknown);
  in.at(24, 69) = 12.5f;
  const Guide guide(70, 25, 1, 13);
  for (Isa isa : usableIsas())
    for (float d : run(completeByBilateral, in, guide.view, {1.0f, 30.0f}, isa, 2).pixels)
      ASSERT_NEAR(d, 12.5f, 1e-3f) << name(isa);
}

TEST(CompleteByBilateral, EndsWhereNothingCanBeFilled) {
  const Guide guide(33, 9, 1, 14);
  const Map<float> unknown(33, 9, kUnknown);
  expectTwin(completeByBilateral, unknown, guide.view, {}, unknown);

  std::vector<std::uint8_t> bytes(20, 0);  // no weight crosses from grey level 0 to 255 at this sigma_r
  Map<float> half(20, 1, kUnknown), expected(20, 1, kUnknown);
  for (int x = 0; x < 10; ++x) bytes[x] = 255, expected.at(0, x) = 3.0f;
  half.at(0, 4) = 3.0f;
  expectTwin(completeByBilateral, half, {bytes.data(), 20, 1, 1, 20}, {2.0f, 5.0f}, expected);
}

TEST(JointBilateral, RefusesBadParameters) {
  Arena scratch;
  Framed<float> map(Map<float>(4, 4, 1.0f), 0, 0);
  const std::vector<std::uint8_t> bytes(64, 0);
  const auto filter = [&](float sigma_space, float sigma_range, int channels) {
    jointBilateral(map.view(), {bytes.data(), 4, 4, channels, 16}, {sigma_space, sigma_range}, map.view(),
                   scratch, filterKernels(Isa::kScalar), 1);
  };
  EXPECT_NO_THROW(filter(1, 1, 1));
  for (float bad : {0.0f, -1.0f, kUnknown, std::numeric_limits<float>::infinity()}) {
    EXPECT_THROW(filter(bad, 1, 1), std::invalid_argument);
    EXPECT_THROW(filter(1, bad, 1), std::invalid_argument);
  }
  for (int channels : {0, 2, 4}) EXPECT_THROW(filter(1, 1, channels), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
