#include "filters/left_right.h"

#include <cstdint>
#include <vector>

#include "core/cpu.h"
#include "filters_testing.h"

namespace pomona {
namespace {

using testing::Framed;
using testing::kUnknown;
using testing::Map;
using testing::sameBits;

/// What the right view would measure: the largest disparity that lands on each of its pixels.
Map<float> rightView(const Map<float>& left) {
  Map<float> right(left.width, left.height, kUnknown);
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < left.width; ++x) {
      const int u = static_cast<int>(std::floor(x - left.at(y, x) + 0.5f));
      if (right.contains(y, u) && !(right.at(y, u) >= left.at(y, x))) right.at(y, u) = left.at(y, x);
    }
  return right;
}

void expectTwin(const Map<float>& left, const Map<std::uint8_t>& state, const Map<float>& right,
                const LeftRightLimits& limits) {
  Map<float> expected = left;
  Map<std::uint8_t> expected_state = state;
  reference::leftRightCheck(expected, expected_state, right, limits.threshold_px, limits.min_disparity,
                            limits.disparities);
  for (Isa isa : usableIsas())
    for (int threads : testing::kThreadCounts)
      for (int margin : {0, 3}) {
        SCOPED_TRACE(::testing::Message()
                     << left.width << 'x' << left.height << " threshold " << limits.threshold_px
                     << " disparities from " << limits.min_disparity << ", " << limits.disparities << "; isa "
                     << name(isa) << " threads " << threads << " margin " << margin);
        Framed<float> d(left, margin, 5.0f), r(right, margin, 5.0f);
        Framed<std::uint8_t> s(state, margin, 0);
        leftRightCheck(d.view(), s.view(), r.view(), limits, filterKernels(isa), threads);
        ASSERT_TRUE(sameBits(d.map(), expected));
        ASSERT_TRUE(sameBits(s.map(), expected_state));
        ASSERT_TRUE(d.frameIsIntact() && s.frameIsIntact() && r.frameIsIntact());
      }
}

void expectTwinOnRandomMaps(int width, int height) {
  for (const LeftRightLimits& limits : {LeftRightLimits{1.0f, 0, 32},
                                        {0.0f, -5, 40},
                                        {0.5f, 3, 1},
                                        {2.0f, 0, 200},
                                        {1.0f, -60, 7},
                                        {2.5f, -300, kMostCheckedDisparities},
                                        {2.5f, 100, 50}}) {
    const unsigned seed = 7u * width + height;
    Map<float> left = testing::randomDisparity(width, height, 0.2, seed);
    Map<float> right = rightView(testing::randomDisparity(width, height, 0.3, seed));
    for (float& d : left.pixels) d += static_cast<float>(limits.min_disparity);
    for (float& d : right.pixels) d += static_cast<float>(limits.min_disparity);
    expectTwin(left, testing::stateOf(left), right, limits);
  }
}

TEST(LeftRightCheck, EqualsItsTwin) {
  for (int width : testing::kWidths)
    for (int height : {1, 19}) expectTwinOnRandomMaps(width, height);
}

TEST(LeftRightCheck, EqualsItsTwinOnRowsOfSeveralChunks) {
  for (int width : {kMatchChunk, kMatchChunk + 1, 3 * kMatchChunk - 1}) expectTwinOnRandomMaps(width, 9);
}

TEST(LeftRightCheck, EqualsItsTwinOnExtremeFills) {
  const float far = 1e30f, inf = std::numeric_limits<float>::infinity();
  for (float left : {kUnknown, 0.0f, 4.5f, far, -far, inf})
    for (float right : {kUnknown, 0.0f, 4.0f, inf}) {
      const Map<float> map(33, 5, left);
      expectTwin(map, Map<std::uint8_t>(33, 5, 0), Map<float>(33, 5, right), {0.5f, 0, 16});
    }
}

TEST(LeftRightCheck, PixelsOfOtherStatesAreLeftAlone) {
  const Map<float> left(20, 2, 3.0f), right(20, 2, 9.0f);
  for (PixelState other : {PixelState::kFilledBackground, PixelState::kAmbiguous, PixelState::kMasked}) {
    Framed<float> d(left, 0, 0);
    Framed<std::uint8_t> s(Map<std::uint8_t>(20, 2, static_cast<std::uint8_t>(other)), 0, 0);
    Framed<float> r(right, 0, 0);
    leftRightCheck(d.view(), s.view(), r.view(), {1, 0, 16}, filterKernels(chooseIsa({})), 1);
    EXPECT_TRUE(sameBits(d.map(), left)) << "state " << static_cast<int>(other);
  }
}

// A foreground of disparity 10 at columns 24..33 before a background of disparity 2. The right camera sees
// the foreground at 14..23, the background elsewhere: of the background that lands under it, columns 16..23
// are visible to the left camera. Their outermost two are within the tolerance of visible neighbours.
TEST(LeftRightCheck, TellsOcclusionFromMismatchFromOutOfRange) {
  Map<float> left(48, 1, 2.0f), right(48, 1, 2.0f);
  for (int x = 24; x < 34; ++x) left.at(0, x) = 10.0f;
  for (int x = 14; x < 24; ++x) right.at(0, x) = 10.0f;
  right.at(0, 46) = right.at(0, 47) = kUnknown;
  left.at(0, 40) = 7.0f;  // wrong: its true disparity 2 is confirmed by the right view

  Framed<float> d(left, 0, 0), r(right, 0, 0);
  Framed<std::uint8_t> s(testing::stateOf(left), 0, 0);
  leftRightCheck(d.view(), s.view(), r.view(), {1, 0, 16}, filterKernels(chooseIsa({})), 1);
  for (int x = 0; x < 48; ++x) {
    const PixelState expected = x < 2                           ? PixelState::kOutOfRange
                                : x >= 17 && x < 23             ? PixelState::kOccluded
                                : x == 16 || x == 23 || x == 40 ? PixelState::kMismatched
                                                                : PixelState::kMeasured;
    EXPECT_EQ(static_cast<int>(s.view().at(0, x)), static_cast<int>(expected)) << "column " << x;
    EXPECT_EQ(std::isnan(d.view().at(0, x)), expected != PixelState::kMeasured) << "column " << x;
  }
}

}  // namespace
}  // namespace pomona
