#include "filters/plane_refine.h"

#include <limits>
#include <random>
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

// The fit adds less than a pixel to the disparity, and is computed in floats.
constexpr double kTolerance_px = 1e-5;

Map<float> run(const Map<float>& in, GuideView guide, int radius, Isa isa, int threads, int margin = 0,
               bool in_place = false) {
  static Arena scratch;  // kept from size to size, as an engine does
  Framed<float> from(in, margin, 55.0f);
  Framed<float> to(Map<float>(in.width, in.height, 77.0f), margin, 77.0f);
  Framed<float>& out = in_place ? from : to;
  refinePlanes(from.view(), guide, radius, out.view(), scratch, filterKernels(isa), threads);
  EXPECT_TRUE(to.frameIsIntact() && from.frameIsIntact());
  return out.map();
}

/// Near the twin, and the same bytes however it is computed.
void expectTwin(const Map<float>& in, GuideView guide) {
  for (int radius : {2, 3}) {
    SCOPED_TRACE(::testing::Message()
                 << in.width << 'x' << in.height << " channels " << guide.channels << " radius " << radius);
    const Map<float> expected = reference::refinePlanes(in, guide, radius);
    const Map<float> scalar = run(in, guide, radius, Isa::kScalar, 1);
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
      ASSERT_EQ(std::isnan(scalar.pixels[i]), std::isnan(expected.pixels[i])) << "pixel " << i;
      if (!std::isnan(expected.pixels[i])) {
        ASSERT_NEAR(scalar.pixels[i], expected.pixels[i], kTolerance_px) << "pixel " << i;
      }
    }
    for (Isa isa : usableIsas())
      for (int threads : testing::kThreadCounts)
        for (int margin : {0, 3})
          ASSERT_TRUE(sameBits(run(in, guide, radius, isa, threads, margin, margin == 3), scalar))
              << "isa " << name(isa) << " threads " << threads << " margin " << margin;
  }
}

struct FlatGuide {
  std::vector<std::uint8_t> gray;
  GuideView view;
  FlatGuide(int width, int height)
      : gray(static_cast<std::size_t>(width) * height, 90), view{gray.data(), width, height, 1, width} {}
};

TEST(PlaneRefinement, EqualsItsTwinForAnyShareOfUnknownPixels) {
  for (int width : testing::kWidths)
    for (int height : {1, 2, 29})
      for (int channels : {1, 3})
        for (double unknown : {0.0, 0.1, 0.6})
          expectTwin(testing::randomDisparity(width, height, unknown, 5u * width + height),
                     Guide(width, height, channels, 3u * width + channels).view);
}

TEST(PlaneRefinement, EqualsItsTwinOnExtremeFills) {
  const Guide guide(35, 9, 3, 1);
  const float largest = std::numeric_limits<float>::max();
  for (float fill : {kUnknown, 0.0f, -3.25f, largest, -largest}) {
    Map<float> map(35, 9, fill);
    expectTwin(map, guide.view);
    map.at(3, 17) = 1.0f;
    map.at(4, 17) = -largest;
    expectTwin(map, guide.view);
  }
}

TEST(PlaneRefinement, EqualsItsTwinWhereColoursDifferByTheBound) {
  std::vector<std::uint8_t> bytes(40 * 20 * 3);
  std::mt19937 random(4);
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() % 3 == 0 ? 114 : 99 + random() % 2);
  expectTwin(testing::randomDisparity(40, 20, 0.0, 6), {bytes.data(), 40, 20, 3, 120});
  for (std::uint8_t& b : bytes) b = random() % 8 == 0 ? 255 : 0;
  expectTwin(testing::randomDisparity(40, 20, 0.0, 7), {bytes.data(), 40, 20, 3, 120});
}

TEST(PlaneRefinement, TakesNoiseFromASlantedPlaneWithoutBias) {
  const int width = 200, height = 150;
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0, 0.1f);
  Map<float> noisy(width, height, 0);
  const auto plane = [](int y, int x) { return 20.0f + 0.25f * x - 0.1f * y; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) noisy.at(y, x) = plane(y, x) + noise(random);
  double previous = 0.1;
  for (int radius : {2, 3}) {
    const Map<float> out = run(noisy, FlatGuide(width, height).view, radius, usableIsas().back(), 1);
    double sum = 0, squares = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double error = out.at(y, x) - plane(y, x);
        sum += error;
        squares += error * error;
      }
    const double rms = std::sqrt(squares / (width * height));
    EXPECT_LT(std::abs(sum / (width * height)), 0.001) << radius;
    EXPECT_LT(rms, (radius == 2 ? 0.3 : 0.9) * previous) << radius;
    previous = rms;
  }
}

TEST(PlaneRefinement, KeepsTheSurfacesBesideAJumpApart) {
  const int width = 60, height = 30, jump = 31;
  Map<float> map(width, height, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.at(y, x) = x < jump ? 10.0f + 0.05f * x : 15.0f - 0.05f * y;
  const Map<float> out = run(map, FlatGuide(width, height).view, 2, usableIsas().back(), 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) EXPECT_NEAR(out.at(y, x), map.at(y, x), 0.02) << y << ' ' << x;
}

TEST(PlaneRefinement, DoesNotMixColours) {
  const int width = 40, height = 20, edge = 17;
  Map<float> map(width, height, 5.0f);
  FlatGuide guide(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = edge; x < width; ++x) {
      map.at(y, x) = 5.5f;
      guide.gray[y * width + x] += 15;
    }
  for (Isa isa : usableIsas()) EXPECT_TRUE(sameBits(run(map, guide.view, 2, isa, 1), map)) << name(isa);
}

TEST(PlaneRefinement, RefusesOtherWindowsAndGuides) {
  const std::vector<std::uint8_t> bytes(8 * 8 * 4, 0);
  const Map<float> map(8, 8, 1.0f);
  for (int radius : {-2, 0, 1, 4})
    EXPECT_THROW(run(map, {bytes.data(), 8, 8, 1, 8}, radius, Isa::kScalar, 1), std::invalid_argument)
        << radius;
  for (int channels : {0, 2, 4})
    EXPECT_THROW(run(map, {bytes.data(), 8, 8, channels, 32}, 2, Isa::kScalar, 1), std::invalid_argument)
        << channels;
}

}  // namespace
}  // namespace pomona
