#include "filters/median.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "core/cpu.h"
#include "filters_testing.h"

namespace pomona {
namespace {

using testing::Framed;
using testing::kUnknown;
using testing::Map;
using testing::sameBits;

void expectTwin(const Map<float>& map, MedianScratch& scratch) {
  for (int size : {3, 5}) {
    const Map<float> expected = reference::medianFilter(map, size);
    for (Isa isa : usableIsas())
      for (int threads : testing::kThreadCounts)
        for (int margin : {0, 3}) {
          SCOPED_TRACE(::testing::Message() << map.width << 'x' << map.height << " size " << size << " isa "
                                            << name(isa) << " threads " << threads << " margin " << margin);
          Framed<float> in(map, margin, 1.0f);
          Framed<float> out(Map<float>(map.width, map.height, 77.0f), margin, 77.0f);
          medianFilter(in.view(), out.view(), size, filterKernels(isa), scratch, threads);
          ASSERT_TRUE(sameBits(out.map(), expected));
          ASSERT_TRUE(out.frameIsIntact());
          medianFilter(in.view(), in.view(), size, filterKernels(isa), scratch, threads);
          ASSERT_TRUE(sameBits(in.map(), expected)) << "in place";
          ASSERT_TRUE(in.frameIsIntact());
        }
  }
}

TEST(MedianFilter, EqualsItsTwinForAnyShareOfUnknownPixels) {
  MedianScratch scratch;  // kept from size to size, as an engine does
  for (int width : testing::kWidths)
    for (int height : {1, 2, 37})
      for (double unknown : {0.0, 0.1, 0.5, 0.9})
        expectTwin(testing::randomDisparity(width, height, unknown, 13u * width + height), scratch);
}

TEST(MedianFilter, EqualsItsTwinOnExtremeFills) {
  MedianScratch scratch;
  const float largest = std::numeric_limits<float>::max();
  for (float fill : {kUnknown, 0.0f, -3.25f, largest, -largest}) {
    Map<float> map(35, 6, fill);
    expectTwin(map, scratch);
    map.at(3, 17) = 1.0f;
    expectTwin(map, scratch);
  }
}

TEST(MedianFilter, OfTwoMiddleValuesTakesTheLower) {
  Map<float> map(3, 3, kUnknown);
  map.at(1, 1) = 4.0f;
  map.at(0, 0) = 1.0f;
  map.at(2, 2) = 2.0f;
  map.at(0, 2) = 8.0f;
  MedianScratch scratch;
  for (Isa isa : usableIsas()) {
    Framed<float> in(map, 0, 0), out(map, 0, 0);
    medianFilter(in.view(), out.view(), 3, filterKernels(isa), scratch, 1);
    EXPECT_EQ(out.view().at(1, 1), 2.0f) << name(isa);
    EXPECT_TRUE(std::isnan(out.view().at(0, 1))) << name(isa);
  }
}

TEST(MedianFilter, RefusesOtherSizes) {
  MedianScratch scratch;
  for (int size : {-3, 0, 1, 2, 4, 7}) {
    Framed<float> in(Map<float>(8, 8, 1.0f), 0, 0), out(Map<float>(8, 8, 1.0f), 0, 0);
    EXPECT_THROW(medianFilter(in.view(), out.view(), size, filterKernels(Isa::kScalar), scratch, 1),
                 std::invalid_argument)
        << size;
  }
}

}  // namespace
}  // namespace pomona
