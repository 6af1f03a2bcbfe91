#include "filters/speckle.h"

#include <cstdint>

#include "core/cpu.h"
#include "filters_testing.h"

namespace pomona {
namespace {

using testing::Framed;
using testing::kUnknown;
using testing::Map;
using testing::sameBits;

void expectTwin(const Map<float>& map, int min_size, float max_step, Arena& scratch) {
  const Map<std::uint8_t> state = testing::stateOf(map);
  Map<float> expected = map;
  Map<std::uint8_t> expected_state = state;
  reference::removeSpeckles(expected, expected_state, min_size, max_step);
  for (Isa isa : usableIsas())
    for (int threads : testing::kThreadCounts)
      for (int margin : {0, 3}) {
        SCOPED_TRACE(::testing::Message()
                     << map.width << 'x' << map.height << " size " << min_size << " step " << max_step
                     << " isa " << name(isa) << " threads " << threads << " margin " << margin);
        Framed<float> d(map, margin, 5.0f);
        Framed<std::uint8_t> s(state, margin, 99);
        removeSpeckles(d.view(), s.view(), min_size, max_step, scratch, filterKernels(isa), threads);
        ASSERT_TRUE(sameBits(d.map(), expected));
        ASSERT_TRUE(sameBits(s.map(), expected_state));
        ASSERT_TRUE(d.frameIsIntact() && s.frameIsIntact());
      }
}

TEST(RemoveSpeckles, EqualsItsTwinOnRandomMaps) {
  Arena scratch;  // kept from size to size, as an engine does
  for (int width : testing::kWidths)
    for (int height : {1, 33, 70})
      for (double unknown : {0.05, 0.45}) {
        const Map<float> map = testing::randomDisparity(width, height, unknown, 31u * width + height);
        for (int min_size : {0, 2, 12, 60, 1000000})
          for (float step : {0.0f, 0.25f, 1.0f}) expectTwin(map, min_size, step, scratch);
      }
}

TEST(RemoveSpeckles, EqualsItsTwinOnExtremeFills) {
  Arena scratch;
  for (float fill : {kUnknown, 0.0f, -7.5f, 1e30f})
    for (int min_size : {70 * 90, 70 * 90 + 1}) expectTwin(Map<float>(70, 90, fill), min_size, 1, scratch);
}

// One path winds through the whole map; the teeth of a comb meet only in its last row. Both cross every
// strip.
TEST(RemoveSpeckles, FollowsWindingComponents) {
  constexpr int kSize = 101;
  Map<float> serpentine(kSize, kSize, kUnknown), comb(kSize, kSize, kUnknown);
  int serpentine_size = 0, comb_size = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const bool turn = x == (y % 4 == 1 ? kSize - 1 : 0);
      if (y % 2 == 0 || turn) serpentine.at(y, x) = 3.0f, ++serpentine_size;
      if (x % 2 == 0 || y == kSize - 1) comb.at(y, x) = 3.0f, ++comb_size;
    }
  Arena scratch;
  for (int extra : {0, 1}) {
    expectTwin(serpentine, serpentine_size + extra, 1, scratch);
    expectTwin(comb, comb_size + extra, 1, scratch);
    Framed<float> d(serpentine, 0, 0);
    Framed<std::uint8_t> s(testing::stateOf(serpentine), 0, 0);
    removeSpeckles(d.view(), s.view(), serpentine_size + extra, 1, scratch, filterKernels(chooseIsa({})), 2);
    EXPECT_EQ(std::isnan(d.view().at(50, 50)), extra == 1);
  }
}

// Alternating disparities: no pixel is connected to any other, the most runs a map can have.
TEST(RemoveSpeckles, HandlesAMapOfSinglePixels) {
  Map<float> map(129, 70, 0.0f);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) map.at(y, x) = (x + y) % 2 ? 10.0f : 0.0f;
  Arena scratch;
  for (float step : {9.0f, 10.0f}) expectTwin(map, 2, step, scratch);
}

}  // namespace
}  // namespace pomona
