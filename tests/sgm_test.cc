#include "tests/reference/sgm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/cpu.h"
#include "pomona/pixel_state.h"
#include "sgm/census.h"
#include "sgm/matcher.h"
#include "sgm/mutual_information.h"
#include "sgm/sobel.h"

namespace pomona {
namespace {

enum class Content { kNoise, kShifted, kConstant, kCheckerboard, kStep };

template <typename T>
struct TestPair {
  Image<T> left, right;
};

std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

template <typename T>
TestPair<T> makePair(int width, int height, Content content) {
  TestPair<T> pair{Image<T>(width, height), Image<T>(width, height)};
  const unsigned range = sizeof(T) == 1 ? 256 : 4096;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto noise = [&](int column, int seed) {
        return static_cast<T>(hash(static_cast<std::uint32_t>(y * 4099 + column + seed * 77777 + 31)) %
                              range);
      };
      T l = 0, r = 0;
      switch (content) {
        case Content::kNoise:
          l = noise(x, 0), r = noise(x, 1);
          break;
        case Content::kShifted:
          l = noise(x, 0), r = noise(x + 3 + y / 8, 0);
          break;
        case Content::kConstant:
          l = r = static_cast<T>(range - 1);
          break;
        case Content::kCheckerboard:
          l = r = (x + y) % 2 ? static_cast<T>(range - 1) : 0;
          break;
        case Content::kStep:
          l = x < width / 2 ? 0 : static_cast<T>(range - 1), r = y < height / 2 ? 0 : l;
          break;
      }
      pair.left.row(y)[x] = l;
      pair.right.row(y)[x] = r;
    }
  return pair;
}

struct Setup {
  int width, height, disparities, min_disparity;
  MatchingCost cost;
  AggregationOptions aggregation;
  Content content;
};

std::string describe(const Setup& s, Isa isa, int threads) {
  return std::to_string(s.width) + "x" + std::to_string(s.height) + " D " + std::to_string(s.disparities) +
         " from " + std::to_string(s.min_disparity) + " cost " + std::to_string(static_cast<int>(s.cost)) +
         " paths " + std::to_string(s.aggregation.paths) + " P1 " + std::to_string(s.aggregation.p1) +
         " P2 " + std::to_string(s.aggregation.p2) + " adaptation " +
         std::to_string(static_cast<int>(s.aggregation.adaptation)) + " content " +
         std::to_string(static_cast<int>(s.content)) + " isa " + std::string(name(isa)) + " threads " +
         std::to_string(threads);
}

/// What the sink of an Aggregator is given, of the whole image.
struct WinnerMaps {
  Image<std::uint16_t> index, best, below, above, second, right_index, right_best, right_below, right_above;

  WinnerMaps(int width, int height) {
    for (Image<std::uint16_t>* map :
         {&index, &best, &below, &above, &second, &right_index, &right_best, &right_below, &right_above})
      map->resize(width, height);
  }
  bool operator==(const WinnerMaps& other) const {
    const auto same = [](const Image<std::uint16_t>& a, const Image<std::uint16_t>& b) {
      for (int y = 0; y < a.height(); ++y)
        if (!std::equal(a.row(y), a.row(y) + a.width(), b.row(y))) return false;
      return true;
    };
    return same(index, other.index) && same(best, other.best) && same(below, other.below) &&
           same(above, other.above) && same(second, other.second) && same(right_index, other.right_index) &&
           same(right_best, other.right_best) && same(right_below, other.right_below) &&
           same(right_above, other.right_above);
  }
  void take(int y, const WinnerRow& w) {
    const auto copy = [&](const std::uint16_t* from, Image<std::uint16_t>& to) {
      std::copy_n(from, to.width(), to.row(y));
    };
    copy(w.index, index), copy(w.best, best), copy(w.below, below), copy(w.above, above);
    copy(w.second, second), copy(w.right_index, right_index), copy(w.right_best, right_best);
    copy(w.right_below, right_below), copy(w.right_above, right_above);
  }
};

/// Both memory modes, which must agree with the textbook and so with each other.
template <typename Check>
void aggregateBoth(const MatchingCostRows& cost, const ColorSteps& steps, const AggregationOptions& options,
                   const SgmKernels& kernels, int threads, Check&& check) {
  for (MemoryMode memory : {MemoryMode::kSpeed, MemoryMode::kLow}) {
    Arena scratch;
    WinnerMaps winners(cost.width(), cost.height());
    aggregate(
        cost, steps, options, memory, kernels, [&](int y, const WinnerRow& row) { winners.take(y, row); },
        scratch, threads);
    check(winners, memory == MemoryMode::kLow ? ", low memory" : "");
  }
}

void expectEqual(const WinnerMaps& got, const reference::Match& want, const std::string& what) {
  const int width = got.index.width();
  for (int y = 0; y < got.index.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      const auto value = [&](const Image<std::uint16_t>& map) { return static_cast<int>(map.row(y)[x]); };
      const auto orNone = [](int v) { return v < 0 ? 0xFFFF : v; };
      ASSERT_EQ(
          std::make_tuple(value(got.index), value(got.best), value(got.below), value(got.above),
                          value(got.second)),
          std::make_tuple(want.index[i], want.best[i], want.below[i], want.above[i], orNone(want.second[i])))
          << what << " at x " << x << " y " << y;
      ASSERT_EQ(std::make_tuple(value(got.right_index), value(got.right_best), value(got.right_below),
                                value(got.right_above)),
                std::make_tuple(orNone(want.right_index[i]), orNone(want.right_best[i]),
                                orNone(want.right_below[i]), orNone(want.right_above[i])))
          << what << " at x " << x << " y " << y;
    }
}

/// A colour image full of steps, large and small, to steer penalties and supports.
Image<std::uint8_t> makeGuide(int width, int height) {
  Image<std::uint8_t> guide(3 * width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 3 * width; ++x) {
      const std::uint32_t h = hash(static_cast<std::uint32_t>(y * 7001 + x));
      guide.row(y)[x] = static_cast<std::uint8_t>(h % 4 == 0 ? h >> 8 : 100 + (h >> 8) % 12);
    }
  return guide;
}

GuideView colorView(const Image<std::uint8_t>& guide) {
  return {guide.row(0), guide.width() / 3, guide.height(), 3, guide.view().stride};
}

template <typename T>
void compareWithTextbook(const Setup& s) {
  const TestPair<T> pair = makePair<T>(s.width, s.height, s.content);
  const Image<std::uint8_t> guide = makeGuide(s.width, s.height);
  const reference::Match want =
      reference::matchCensus<T>(pair.left.view(), pair.right.view(), colorView(guide), s.cost, s.aggregation,
                                s.min_disparity, s.disparities);
  for (Isa isa : usableIsas())
    for (int threads : {1, 2, 7}) {
      const SgmKernels& kernels = sgmKernels(isa);
      Arena arena;
      const CensusPlanes left = computeCensus<T>(pair.left.view(), s.cost, kernels, arena, threads);
      const CensusPlanes right = computeCensus<T>(pair.right.view(), s.cost, kernels, arena, threads);
      const ColorSteps steps(colorView(guide), kernels);
      MatchingCostRows cost;
      cost.startCensus({&left, {}, {}}, maximumCost(s.cost),
                       makeRange(s.min_disparity, s.disparities, kernels), kernels, arena);
      cost.setRight({&right, {}, {}}, threads);
      aggregateBoth(cost, steps, s.aggregation, kernels, threads,
                    [&](const WinnerMaps& got, const char* memory) {
                      expectEqual(got, want, describe(s, isa, threads) + memory);
                    });
      if (testing::Test::HasFatalFailure()) return;
    }
}

const AggregationOptions kSoft{8, 5, 60, 20, PenaltyAdaptation::kSoftIntensity};

TEST(Sgm, EqualsTextbookForRaggedWidthsAndRanges) {
  for (int width : {1, 2, 7, 31, 33, 65, 130})
    for (int disparities : {1, 2, 3, 16, 63, 64, 65, 128, 129})
      if (disparities <= width || disparities == 3)
        compareWithTextbook<std::uint8_t>(
            {width, 9, disparities, 0, MatchingCost::kCensus5x5, kSoft, Content::kShifted});
}

TEST(Sgm, EqualsTextbookForEveryCostAndPixelDepth) {
  for (MatchingCost cost : {MatchingCost::kCensus5x5, MatchingCost::kCensus7x7, MatchingCost::kCensus9x7,
                            MatchingCost::kCenterSymmetricCensus9x7})
    for (Content content :
         {Content::kNoise, Content::kShifted, Content::kConstant, Content::kCheckerboard, Content::kStep}) {
      compareWithTextbook<std::uint8_t>({40, 17, 33, 0, cost, kSoft, content});
      compareWithTextbook<std::uint16_t>({40, 17, 20, 0, cost, kSoft, content});
    }
}

TEST(Sgm, EqualsTextbookForEveryPenaltySetting) {
  // 63 is the last P2 whose partial sums fit a byte; 62 + 30 + 163 reaches the 8-bit bound exactly.
  for (int paths : {4, 8})
    for (auto [p1, p2] : {std::pair{1, 1}, {5, 63}, {5, 64}, {30, 163}, {60, 63}})
      for (PenaltyAdaptation a : {PenaltyAdaptation::kConstant, PenaltyAdaptation::kInverseIntensity,
                                  PenaltyAdaptation::kSoftIntensity})
        for (Content content : {Content::kNoise, Content::kStep})
          compareWithTextbook<std::uint8_t>(
              {70, 20, 66, 0, MatchingCost::kCensus9x7, {paths, p1, p2, std::max(p1, p2 / 3), a}, content});
}

TEST(Sgm, EqualsTextbookForNegativeAndOffsetRanges) {
  for (int min_disparity : {-70, -64, -9, -1, 1, 8, 40})
    compareWithTextbook<std::uint8_t>(
        {65, 12, 30, min_disparity, MatchingCost::kCensus5x5, kSoft, Content::kShifted});
}

TEST(Sgm, EqualsTextbookWhereSumsAndIndicesShareAWord) {
  // Sums of 8 (24 + 39) = 504 leave seven bits for the index, those of 512 leave only six.
  for (int p2 : {39, 40})
    for (int disparities : {64, 65, 100, 128})
      for (int min_disparity : {-5, 0, 9})
        for (Content content : {Content::kConstant, Content::kNoise, Content::kShifted})
          compareWithTextbook<std::uint8_t>({140,
                                             8,
                                             disparities,
                                             min_disparity,
                                             MatchingCost::kCensus5x5,
                                             {8, 5, p2, 10, PenaltyAdaptation::kSoftIntensity},
                                             content});
}

TEST(Sgm, EqualsTextbookWhereIndicesShareALabel) {
  // Two disparities for each label of seven bits, up to four for one of six; five to eight vectors of AVX2.
  for (int p2 : {39, 40})
    for (int disparities : {129, 190, 224, 256})
      for (int min_disparity : {-5, 9})
        for (Content content : {Content::kConstant, Content::kNoise, Content::kShifted})
          compareWithTextbook<std::uint8_t>({270,
                                             4,
                                             disparities,
                                             min_disparity,
                                             MatchingCost::kCensus5x5,
                                             {8, 5, p2, 10, PenaltyAdaptation::kSoftIntensity},
                                             content});
}

TEST(Sgm, EqualsTextbookForThinImages) {
  for (int height : {1, 2, 3})
    for (int width : {1, 5, 40})
      compareWithTextbook<std::uint8_t>(
          {width, height, 4, 0, MatchingCost::kCensus7x7, kSoft, Content::kNoise});
}

TEST(Sgm, EqualsTextbookForTheWidestRange) {
  compareWithTextbook<std::uint8_t>({1030, 2, 1024, 0, MatchingCost::kCensus5x5, kSoft, Content::kShifted});
}

TEST(Sgm, BlendedCostWithSupportEqualsTextbook) {
  for (Content content : {Content::kNoise, Content::kShifted, Content::kCheckerboard, Content::kStep})
    for (int step : {0, 8, 255})
      for (auto [width, height] : {std::pair{1, 1}, {5, 3}, {70, 14}}) {
        const int disparities = std::min(width, 66), from = width > 50 ? -2 : 0;
        const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(width, height, content);
        const Image<std::uint8_t> guide = makeGuide(width, height);
        auto cost_of = reference::blendedCost(pair.left.view(), pair.right.view(), from);
        if (step > 0) cost_of = reference::supported(cost_of, colorView(guide), step);
        const reference::Match want = reference::match(
            {width, height, disparities, from, 8, kSoft.p1, cost_of, [&](int y, int x, int y2, int x2) {
               return reference::adaptedPenalty(kSoft, reference::colorStep(colorView(guide), y, x, y2, x2));
             }});
        for (Isa isa : usableIsas())
          for (int threads : {1, 2}) {
            const SgmKernels& kernels = sgmKernels(isa);
            Arena arena;
            CensusPlanes codes[2];
            ImageView<std::uint8_t> sobel[2];
            const ImageView<const std::uint8_t> gray[2] = {pair.left.view(), pair.right.view()};
            for (int i = 0; i < 2; ++i) {
              codes[i] = computeCensus(gray[i], MatchingCost::kBlended, kernels, arena, threads);
              sobel[i] = computeSobel(gray[i], kernels, arena, threads);
            }
            const ColorSteps steps(colorView(guide), kernels);
            MatchingCostRows cost;
            cost.startBlended({&codes[0], sobel[0], gray[0]}, 45, makeRange(from, disparities, kernels),
                              kernels, arena);
            cost.setRight({&codes[1], sobel[1], gray[1]}, threads);
            cost.prepareSupport(steps, step, arena, threads);
            aggregateBoth(
                cost, steps, kSoft, kernels, threads, [&](const WinnerMaps& got, const char* memory) {
                  expectEqual(got, want,
                              "blended, " + std::string(name(isa)) + " support " + std::to_string(step) +
                                  " content " + std::to_string(static_cast<int>(content)) + " width " +
                                  std::to_string(width) + memory);
                });
            if (testing::Test::HasFatalFailure()) return;
          }
      }
}

TEST(Sgm, TableCostEqualsTextbook) {
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(50, 14, Content::kShifted);
  std::vector<std::uint8_t> table(65536);
  for (int i = 0; i < 65536; ++i)
    table[i] = static_cast<std::uint8_t>(hash(static_cast<std::uint32_t>(i)) % 128);
  const AggregationOptions o{8, 10, 90, 30, PenaltyAdaptation::kInverseIntensity};
  const GuideView gray{pair.left.row(0), 50, 14, 1, pair.left.view().stride};
  const reference::Match want = reference::match(
      {50, 14, 37, -3, o.paths, o.p1,
       [&](int y, int x, int d) {
         return table[256 * pair.left.row(y)[x] + pair.right.row(y)[std::clamp(x + 3 - d, 0, 49)]];
       },
       [&](int y, int x, int y2, int x2) {
         return reference::adaptedPenalty(o, reference::colorStep(gray, y, x, y2, x2));
       }});
  for (Isa isa : usableIsas()) {
    const SgmKernels& kernels = sgmKernels(isa);
    Arena arena;
    const ColorSteps steps(gray, kernels);
    MatchingCostRows cost;
    cost.startTable({nullptr, {}, pair.left.view()}, std::span<const std::uint8_t, 65536>(table), 127,
                    makeRange(-3, 37, kernels), kernels, arena);
    cost.setRight({nullptr, {}, pair.right.view()}, 1);
    aggregateBoth(cost, steps, o, kernels, 2, [&](const WinnerMaps& got, const char* memory) {
      expectEqual(got, want, "table cost, isa " + std::string(name(isa)) + memory);
    });
  }
}

TEST(Sgm, PriorAddsItsRampToTheCost) {
  const int width = 70, height = 12, disparities = 66, from = -2, weight = 3, reach = 4;
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(width, height, Content::kShifted);
  const Image<std::uint8_t> guide = makeGuide(width, height);
  Image<float> map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t h = hash(static_cast<std::uint32_t>(y * 100 + x));
      map.row(y)[x] = h % 5 == 0 ? std::nanf("") : static_cast<float>(h % 300) / 4 - 4;
    }
  const auto codes = reference::census<std::uint8_t>(pair.left.view(), MatchingCost::kCensus5x5);
  const auto right_codes = reference::census<std::uint8_t>(pair.right.view(), MatchingCost::kCensus5x5);
  const reference::Match want = reference::match(
      {width, height, disparities, from, 8, kSoft.p1,
       [&](int y, int x, int d) {
         const int column = std::clamp(x - from - d, 0, width - 1);
         const int census = std::popcount(codes[y * width + x] ^ right_codes[y * width + column]);
         if (std::isnan(map.row(y)[x])) return census;
         const double drawn_to =
             std::clamp(map.row(y)[x] - static_cast<double>(from), 0.0, disparities - 0.25);
         return census +
                static_cast<int>(std::floor(weight * std::min(std::abs(d - drawn_to), 1.0 * reach) + 0.5));
       },
       [&](int y, int x, int y2, int x2) {
         return reference::adaptedPenalty(kSoft, reference::colorStep(colorView(guide), y, x, y2, x2));
       }});
  for (Isa isa : usableIsas()) {
    const SgmKernels& kernels = sgmKernels(isa);
    Arena arena;
    const auto codesOf = [&](const Image<std::uint8_t>& gray) {
      return computeCensus<std::uint8_t>(gray.view(), MatchingCost::kCensus5x5, kernels, arena, 2);
    };
    const CensusPlanes left = codesOf(pair.left), right = codesOf(pair.right);
    const ColorSteps steps(colorView(guide), kernels);
    MatchingCostRows cost;
    cost.startCensus({&left, {}, {}}, 24, makeRange(from, disparities, kernels), kernels, arena);
    cost.setRight({&right, {}, {}}, 2);
    cost.preparePrior(map.view(), 0, weight, reach, arena, 2);
    aggregateBoth(cost, steps, kSoft, kernels, 2, [&](const WinnerMaps& got, const char* memory) {
      expectEqual(got, want, "prior, isa " + std::string(name(isa)) + memory);
    });
  }
}

/// The winners of a noisy pair that is large enough for several groups of rows and tiles of columns.
WinnerMaps winnersOf(const MatchOptions& options, Isa isa, int threads) {
  const int width = 215, height = 61;
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(width, height, Content::kShifted);
  const Image<std::uint8_t> guide = makeGuide(width, height);
  WinnerMaps winners(width, height);
  SgmMatcher matcher;
  Arena scratch;
  matcher.findWinners(
      {pair.left.view(), pair.right.view(), {}, {}, colorView(guide)}, options, {}, sgmKernels(isa),
      [&](int y, const WinnerRow& row) { winners.take(y, row); }, scratch, threads);
  return winners;
}

TEST(Sgm, IsTheSameForAnyNumberOfThreads) {
  const MatchOptions cheap{-3, 70, {MatchingCost::kCensus5x5, 0}, {8, 5, 39, 10}, {}};
  MatchOptions stored = cheap, wide = cheap, few_paths = cheap;
  stored.cost = {MatchingCost::kBlended, 8};
  wide.aggregation.p2 = 100;
  few_paths.aggregation.paths = 4;
  for (Isa isa : usableIsas())
    for (MatchOptions o : {cheap, stored, wide, few_paths}) {
      o.memory = MemoryMode::kSpeed;
      const WinnerMaps want = winnersOf(o, isa, 1);
      for (MemoryMode memory : {MemoryMode::kSpeed, MemoryMode::kLow})
        for (int threads : {1, 2, 3, 4, 7, 8, 16}) {
          o.memory = memory;
          const WinnerMaps got = winnersOf(o, isa, threads);
          ASSERT_TRUE(got == want) << name(isa) << " cost " << static_cast<int>(o.cost.cost) << " P2 "
                                   << o.aggregation.p2 << " paths " << o.aggregation.paths << " memory "
                                   << static_cast<int>(memory) << " threads " << threads;
        }
    }
}

TEST(Sgm, LowMemoryKeepsFarLess) {
  const int width = 64, height = 600;
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(width, height, Content::kNoise);
  const Image<std::uint8_t> guide = makeGuide(width, height);
  const auto bytesOf = [&](MemoryMode memory) {
    MatchOptions o{0, 64, {MatchingCost::kCensus5x5, 0}, {8, 5, 39, 10}, {}, memory};
    SgmMatcher matcher;
    Arena scratch;
    for (int frame = 0; frame < 2; ++frame)  // the first makes do with pieces
      matcher.findWinners(
          {pair.left.view(), pair.right.view(), {}, {}, colorView(guide)}, o, {},
          sgmKernels(usableIsas().back()), [](int, const WinnerRow&) {}, scratch, 1);
    return scratch.capacity();
  };
  // The sums of 600 rows against checkpoints and sums that are worth 2 x 43 rows, and what both need.
  EXPECT_LT(2 * bytesOf(MemoryMode::kLow), bytesOf(MemoryMode::kSpeed));
}

TEST(Sgm, MatcherRefinesAndMarksAmbiguousPixels) {
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(60, 16, Content::kShifted);
  const GuideView guide{pair.left.row(0), 60, 16, 1, pair.left.view().stride};
  MatchOptions o{0, 24, {MatchingCost::kCensus5x5, 0}, kSoft, {SubpixelMethod::kNone, 20}};
  const reference::Match want = reference::matchCensus<std::uint8_t>(
      pair.left.view(), pair.right.view(), guide, o.cost.cost, o.aggregation, 0, 24);
  SgmMatcher matcher;
  Arena scratch;
  for (SubpixelMethod method :
       {SubpixelMethod::kNone, SubpixelMethod::kParabola, SubpixelMethod::kEquiangular}) {
    o.winner.subpixel = method;
    MatchMaps maps;
    matcher.match({pair.left.view(), pair.right.view(), {}, {}, guide}, o, {},
                  sgmKernels(usableIsas().back()), maps, scratch, 2);
    int ambiguous = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 60; ++x) {
        const int i = y * 60 + x, b = want.index[i];
        const double below = want.below[i], best = want.best[i], above = want.above[i];
        double expected = b;
        if (b > 0 && b < 23 && method == SubpixelMethod::kParabola)
          expected += (below - above) / (2 * (below - 2 * best + above));
        if (b > 0 && b < 23 && method == SubpixelMethod::kEquiangular)
          expected +=
              below > above ? (below - above) / (2 * (below - best)) : (below - above) / (2 * (above - best));
        EXPECT_NEAR(maps.disparity.row(y)[x], expected, 1e-5);
        const bool unique = best <= 0.8 * want.second[i] + 1e-9;
        EXPECT_EQ(maps.state.row(y)[x] == static_cast<std::uint8_t>(PixelState::kMeasured), unique);
        EXPECT_EQ(maps.margin(y)[x], want.second[i] - best);
        EXPECT_EQ(maps.curvature(y)[x], std::max(0.0, want.below[i] + want.above[i] - 2 * best));
        ambiguous += !unique;
        if (want.right_index[i] < 0) {
          EXPECT_TRUE(std::isnan(maps.right_disparity.row(y)[x]));
        } else {
          EXPECT_NEAR(maps.right_disparity.row(y)[x], want.right_index[i],
                      method == SubpixelMethod::kNone || want.right_below[i] < 0 ? 0 : 0.5);
        }
      }
    EXPECT_GT(ambiguous, 0);
    EXPECT_LT(ambiguous, 60 * 16);
  }
}

TEST(MutualInformation, PrefersThePairsThatOccurTogether) {
  // The right view is the left one under a non-monotone map of its values: census fails, mutual information
  // must not.
  const TestPair<std::uint8_t> pair = makePair<std::uint8_t>(200, 100, Content::kNoise);
  Image<std::uint8_t> left(200, 100), right(200, 100);
  Image<float> disparity(200, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x) {
      left.row(y)[x] = static_cast<std::uint8_t>(pair.left.row(y)[x] / 32 * 32 + 16);
      right.row(y)[x] = static_cast<std::uint8_t>((left.row(y)[x] * 3 + 40) % 256);
      disparity.row(y)[x] = x % 10 == 0 ? std::nanf("") : 0.0f;
    }
  MutualInformation mi;
  mi.update(left.view(), right.view(), disparity.view());
  const auto& table = mi.table();
  EXPECT_EQ(*std::max_element(table.begin(), table.end()), MutualInformation::kMaximumCost);
  for (int i = 16; i < 256; i += 32)
    for (int k = 16; k < 256; k += 32) {
      const int partner = (i * 3 + 40) % 256, other = (k * 3 + 40) % 256;
      if (i != k) {
        EXPECT_LT(table[256 * i + partner] + 20, table[256 * i + other]) << i << ' ' << k;
      }
    }
}

TEST(MutualInformation, NoValidPixelCostsNothing) {
  Image<std::uint8_t> gray(4, 4);
  Image<float> disparity(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) gray.row(y)[x] = 7, disparity.row(y)[x] = std::nanf("");
  MutualInformation mi;
  mi.update(gray.view(), gray.view(), disparity.view());
  for (std::uint8_t c : mi.table()) ASSERT_EQ(c, 0);
}

}  // namespace
}  // namespace pomona
