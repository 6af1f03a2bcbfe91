#include "pyramid/hole_fill.h"

#include "pomona/pixel_state.h"
#include "tests/pyramid_support.h"
#include "tests/reference/pyramid.h"

namespace pomona {
namespace {

constexpr std::uint8_t value(PixelState s) {
  return static_cast<std::uint8_t>(s);
}

// A map to fill and everything that is known about it, each inside poison.
struct Scene {
  Scene(int width, int height, int channels)
      : width(width),
        height(height),
        disparity(width, height, 77.0f),
        right(width, height, 0.0f),
        coarse(width, height, 55.0f),
        state(width, height, value(PixelState::kMeasured)),
        guide(width, height, 200, channels) {
    guide.fill([](int, int, int) { return std::uint8_t{128}; });
    state.fill([](int, int, int) { return value(PixelState::kMeasured); });
    right.fill([](int, int, int) { return kNan; });
    coarse.fill([](int, int, int) { return kNan; });
  }
  void dig(int y, int x, PixelState reason) {
    disparity.at(y, x) = kNan;
    state.at(y, x) = value(reason);
  }
  /// The scene itself is what offers the coarse map, see HoleFillInput::coarse.
  ImageView<const float> operator()() const { return coarse.view(); }
  HoleFillInput input() const { return {guide.guide(), right.view(), *this, radius_px, fallback}; }
  void fill(const PyramidKernels& kernels = pyramidKernels(usableIsas().back()), int threads = 1) {
    Arena scratch;
    fillHoles(input(), disparity.view(), state.view(), scratch, kernels, threads);
  }
  PixelState stateAt(int y, int x) const { return static_cast<PixelState>(state.at(y, x)); }

  int width, height;
  int radius_px = 200;
  float fallback = 3.5f;
  Padded<float> disparity, right, coarse;
  Padded<std::uint8_t> state, guide;
};

// ---- against the twin ----

struct Case {
  int width, height, channels, radius_px;
  int hole_percent;  // of blocks
  int block_px;
  bool coarse;
  std::string text() const {
    return sizeText(width, height) + ", channels " + std::to_string(channels) + ", radius " +
           std::to_string(radius_px) + ", holes " + std::to_string(hole_percent) + " % in blocks of " +
           std::to_string(block_px) + (coarse ? ", coarse" : "");
  }
};

Scene randomScene(const Case& c, unsigned seed) {
  Scene s(c.width, c.height, c.channels);
  std::mt19937 random(seed);
  const PixelState reasons[] = {PixelState::kOccluded, PixelState::kMismatched, PixelState::kAmbiguous,
                                PixelState::kSpeckle,  PixelState::kOutOfRange, PixelState::kMasked,
                                PixelState::kMeasured};
  const auto disparity = [&] { return static_cast<float>(static_cast<int>(random() % 160) - 20) * 0.25f; };
  s.radius_px = c.radius_px;
  s.disparity.fill([&](int, int, int) { return disparity(); });
  s.right.fill([&](int, int, int) { return random() % 4 == 0 ? kNan : disparity(); });
  s.guide.fill([&](int, int, int) { return static_cast<std::uint8_t>(random() % 3 * 100 + random() % 20); });
  if (c.coarse) s.coarse.fill([&](int, int, int) { return random() % 3 == 0 ? kNan : disparity(); });
  for (int y = 0; y < c.height; y += c.block_px)
    for (int x = 0; x < c.width; x += c.block_px) {
      if (static_cast<int>(random() % 100) >= c.hole_percent) continue;
      for (int v = y; v < std::min(c.height, y + c.block_px); ++v)
        for (int u = x; u < std::min(c.width, x + c.block_px); ++u) {
          const PixelState reason = reasons[random() % 7];
          s.dig(v, u, reason);
          if (reason == PixelState::kMasked && random() % 2 == 0)
            s.disparity.at(v, u) = -99;  // never to be used
        }
    }
  for (int i = 0; i < c.width * c.height / 40; ++i) {  // filled before by somebody else
    const int y = static_cast<int>(random() % c.height), x = static_cast<int>(random() % c.width);
    const bool source = i % 2 == 0;
    s.disparity.at(y, x) = source ? disparity() : 500;
    s.state.at(y, x) = value(source ? PixelState::kFilledPlane : PixelState::kFilledInterpolated);
  }
  return s;
}

void runTwin(const Scene& s, std::vector<float>& disparity, std::vector<std::uint8_t>& state) {
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      disparity.push_back(s.disparity.at(y, x));
      state.push_back(s.state.at(y, x));
    }
  const reference::HoleFill twin{s.width,
                                 s.height,
                                 s.guide.channels(),
                                 s.radius_px,
                                 [&](int y, int x, int c) { return int{s.guide.at(y, x, c)}; },
                                 [&](int y, int x) { return s.right.at(y, x); },
                                 [&](int y, int x) { return s.coarse.at(y, x); },
                                 s.fallback};
  twin.run(disparity, state);
}

void expectTwin(const Case& c, unsigned seed) {
  const Scene original = randomScene(c, seed);
  std::vector<float> disparity;
  std::vector<std::uint8_t> state;
  runTwin(original, disparity, state);
  Arena scratch;
  forEachSetting([&](const PyramidKernels& kernels, int threads) {
    Scene s = original;
    fillHoles(s.input(), s.disparity.view(), s.state.view(), scratch, kernels, threads);
    ASSERT_TRUE(s.disparity.poisonIntact() && s.state.poisonIntact()) << c.text();
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * c.width + x;
        const float actual = s.disparity.at(y, x);
        ASSERT_TRUE(actual == disparity[i] || (std::isnan(actual) && std::isnan(disparity[i])))
            << c.text() << ", seed " << seed << " at y " << y << ", x " << x << ": " << actual << " against "
            << disparity[i];
        ASSERT_EQ(s.state.at(y, x), state[i])
            << c.text() << ", seed " << seed << " at y " << y << ", x " << x;
      }
  });
}

TEST(FillHoles, EqualsItsTwin) {
  const std::pair<int, int> sizes[] = {{1, 1}, {7, 4}, {4, 7}, {31, 20}, {33, 33}, {64, 17}, {65, 40}};
  for (const auto& [width, height] : sizes)
    for (int channels : {1, 3})
      for (int radius : {1, 6, 200})
        for (int block : {1, 9})
          for (int percent : {30, 95})
            expectTwin({width, height, channels, radius, percent, block, radius == 6}, 11);
}

TEST(FillHoles, EqualsItsTwinWhereLittleIsMeasured) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    expectTwin({40, 30, 3, 5, 99, 4, false}, seed);
    expectTwin({40, 30, 1, 5, 98, 4, true}, seed);
    expectTwin({9, 70, 1, 3, 100, 5, false}, seed);
  }
}

// ---- scenes whose answer is known ----

float background(int y, int x) {
  return 6.0f + 0.01f * static_cast<float>(x) + 0.005f * static_cast<float>(y);
}
constexpr float kBoxDisparity = 24;
bool inBox(int y, int x) {
  return y >= 20 && y < 60 && x >= 70 && x < 110;
}
float truth(int y, int x) {
  return inBox(y, x) ? kBoxDisparity : background(y, x);
}

// A box before a slanted wall. The right view is the left one warped, nearest surface first; what it doesn't
// show is dug out of the left map as occluded, or out of range at the left border.
Scene boxScene() {
  Scene s(160, 80, 1);
  s.disparity.fill([](int y, int x, int) { return truth(y, x); });
  s.guide.fill([](int y, int x, int) { return static_cast<std::uint8_t>(inBox(y, x) ? 200 : 60); });
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      const int x_right = static_cast<int>(std::lround(static_cast<float>(x) - truth(y, x)));
      if (x_right < 0) continue;
      float& right = s.right.at(y, x_right);
      if (!(right > truth(y, x))) right = truth(y, x);
    }
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      const int x_right = static_cast<int>(std::lround(static_cast<float>(x) - truth(y, x)));
      if (x_right < 0)
        s.dig(y, x, PixelState::kOutOfRange);
      else if (s.right.at(y, x_right) > truth(y, x) + 1)
        s.dig(y, x, PixelState::kOccluded);
    }
  return s;
}

TEST(FillHoles, OccludedBandAndBorderTakeTheBackground) {
  Scene s = boxScene();
  const Scene before = s;
  s.fill();
  int occluded = 0, out_of_range = 0;
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      if (before.stateAt(y, x) == PixelState::kMeasured) {
        ASSERT_EQ(s.disparity.at(y, x), truth(y, x));
        ASSERT_EQ(s.stateAt(y, x), PixelState::kMeasured);
        continue;
      }
      (before.stateAt(y, x) == PixelState::kOccluded ? occluded : out_of_range)++;
      ASSERT_EQ(s.stateAt(y, x), PixelState::kFilledBackground);
      ASSERT_NEAR(s.disparity.at(y, x), background(y, x), 0.4) << "at y " << y << ", x " << x;
    }
  EXPECT_GT(occluded, 40 * 15);  // the scene does have both bands
  EXPECT_GT(out_of_range, 80 * 5);
}

TEST(FillHoles, MismatchesInsideABoxTakeTheBoxAndThoseInTheWallTheWall) {
  Scene s = boxScene();
  const auto damage = [&](int y0, int x0) {
    for (int y = y0; y < y0 + 9; ++y)
      for (int x = x0; x < x0 + 9; ++x)
        s.dig(y, x, y % 2 == 0 ? PixelState::kMismatched : PixelState::kAmbiguous);
  };
  damage(30, 85);
  damage(5, 120);
  s.fill();
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) {
      EXPECT_EQ(s.disparity.at(30 + y, 85 + x), kBoxDisparity);
      EXPECT_NEAR(s.disparity.at(5 + y, 120 + x), background(5 + y, 120 + x), 0.1);
      EXPECT_EQ(s.stateAt(30 + y, 85 + x), PixelState::kFilledInterpolated);
    }
}

// One hole between 4 (left) and 20 (right); the right view decides which of the two can be there.
TEST(FillHoles, TheRightViewRulesOutWhatItWouldSeeHidden) {
  for (const bool sees_behind : {false, true}) {
    Scene s(41, 1, 1);
    s.disparity.fill([](int, int x, int) { return x < 30 ? 4.0f : 20.0f; });
    s.guide.fill([](int, int x, int) { return static_cast<std::uint8_t>(x < 30 ? 0 : 250); });
    for (int x = 28; x < 33; ++x) s.dig(0, x, PixelState::kMismatched);
    s.guide.at(0, 30) = 250;                              // looks like the near surface ...
    s.right.at(0, 30 - 20) = sees_behind ? 4.0f : 20.0f;  // ... which the right view confirms, or denies
    s.fill();
    EXPECT_EQ(s.disparity.at(0, 30), sees_behind ? 4.0f : 20.0f);
  }
}

TEST(FillHoles, WithoutAPossibleCandidateTheRowsBackgroundWins) {
  Scene s(9, 3, 1);
  s.disparity.fill([](int y, int x, int) { return y == 1 ? (x < 4 ? 6.0f : 5.0f) : 4.0f; });
  s.right.fill([](int, int, int) { return -50.0f; });  // everything would be seen: everything is impossible
  s.dig(1, 6, PixelState::kOccluded);
  s.dig(1, 5, PixelState::kOccluded);
  s.dig(1, 4, PixelState::kOccluded);
  s.fill();
  EXPECT_EQ(s.disparity.at(1, 6), 5.0f);  // of 6 and 5, although 4 is near as well
}

TEST(FillHoles, WithoutHolesNothingChanges) {
  Scene s(65, 20, 3);
  s.disparity.fill([](int y, int x, int) { return static_cast<float>(x - y) * 0.3f; });
  s.state.at(3, 4) = value(PixelState::kMasked);
  s.disparity.at(3, 4) = kNan;
  const Scene before = s;
  s.fill();
  EXPECT_TRUE(s.disparity.sameBytes(before.disparity));
  EXPECT_TRUE(s.state.sameBytes(before.state));
}

TEST(FillHoles, MaskedPixelsStayAndAreNoSource) {
  Scene s(33, 12, 1);
  s.disparity.fill([](int, int, int) { return 10.0f; });
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) s.dig(y, x, x == 8 ? PixelState::kMismatched : PixelState::kMasked);
  s.disparity.at(6, 7) = 2.0f;
  s.fill();
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(s.stateAt(y, x), x == 8 ? PixelState::kFilledInterpolated : PixelState::kMasked);
    }
  for (int y = 0; y < 12; ++y) EXPECT_EQ(s.disparity.at(y, 8), 10.0f) << y;
  EXPECT_EQ(s.disparity.at(6, 7), 2.0f);
  EXPECT_TRUE(std::isnan(s.disparity.at(6, 6)));
}

TEST(FillHoles, AnEmptyMapTakesTheCoarseMapAndThenTheFallback) {
  for (const bool has_coarse : {true, false}) {
    Scene s(31, 9, 3);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 31; ++x) s.dig(y, x, PixelState::kAmbiguous);
    if (has_coarse) s.coarse.fill([](int, int x, int) { return static_cast<float>(x); });
    s.fill();
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 31; ++x) {
        EXPECT_EQ(s.disparity.at(y, x), has_coarse ? static_cast<float>(x) : s.fallback);
        EXPECT_EQ(s.stateAt(y, x), has_coarse ? PixelState::kFilledCoarse : PixelState::kFilledInterpolated);
      }
  }
}

TEST(FillHoles, BeyondTheRadiusTheCoarseMapDecidesAndWithoutOneTheRow) {
  for (const bool has_coarse : {true, false}) {
    Scene s(64, 1, 1);
    s.radius_px = 5;
    s.disparity.fill([](int, int, int) { return 9.0f; });
    for (int x = 10; x < 64; ++x) s.dig(0, x, PixelState::kOccluded);
    HoleFillInput in = s.input();
    const auto no_map = [] { return ImageView<const float>{}; };
    if (has_coarse)
      s.coarse.fill([](int, int, int) { return 2.0f; });
    else
      in.coarse = no_map;
    Arena scratch;
    fillHoles(in, s.disparity.view(), s.state.view(), scratch, pyramidKernels(Isa::kScalar), 2);
    EXPECT_EQ(s.disparity.at(0, 14), 9.0f);
    EXPECT_EQ(s.stateAt(0, 14), PixelState::kFilledBackground);
    EXPECT_EQ(s.disparity.at(0, 15), has_coarse ? 2.0f : 9.0f);
    EXPECT_EQ(s.stateAt(0, 15), has_coarse ? PixelState::kFilledCoarse : PixelState::kFilledBackground);
  }
}

TEST(FillHoles, ScratchIsReusableAcrossSizesAndChannelCounts) {
  Arena scratch;
  for (const Case& c : {Case{65, 40, 3, 200, 50, 9, true}, Case{31, 20, 1, 6, 30, 1, false},
                        Case{70, 50, 1, 20, 90, 9, true}}) {
    Scene fresh = randomScene(c, 5), reused = fresh;
    fresh.fill();
    fillHoles(reused.input(), reused.disparity.view(), reused.state.view(), scratch,
              pyramidKernels(Isa::kScalar), 2);
    EXPECT_TRUE(fresh.disparity.sameBytes(reused.disparity)) << c.text();
    EXPECT_TRUE(fresh.state.sameBytes(reused.state)) << c.text();
  }
}

}  // namespace
}  // namespace pomona
