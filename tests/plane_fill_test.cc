#include "pyramid/plane_fill.h"

#include "pyramid/holes.h"
#include "tests/pyramid_support.h"

namespace pomona {
namespace {

constexpr std::uint8_t value(PixelState s) {
  return static_cast<std::uint8_t>(s);
}

// Two surfaces, left and right of x = 96, in two colours; both slanted.
constexpr int kSeam = 96;
float truth(int y, int x) {
  return x < kSeam ? 20 + 0.05f * static_cast<float>(x) - 0.1f * static_cast<float>(y)
                   : 40 - 0.04f * static_cast<float>(x) + 0.08f * static_cast<float>(y);
}

struct Scene {
  explicit Scene(int width = 192, int height = 96, int channels = 3)
      : width(width),
        height(height),
        disparity(width, height, 77.0f),
        right(width, height, 0.0f),
        state(width, height, value(PixelState::kMeasured)),
        guide(width, height, 200, channels) {
    disparity.fill([](int y, int x, int) { return truth(y, x); });
    right.fill([](int, int, int) { return kNan; });
    state.fill([](int, int, int) { return value(PixelState::kMeasured); });
    guide.fill([](int, int x, int c) { return static_cast<std::uint8_t>(x < kSeam ? 60 + c : 190 - c); });
  }
  void dig(int y, int x, PixelState reason) {
    disparity.at(y, x) = kNan;
    state.at(y, x) = value(reason);
  }
  void digBox(int y0, int x0, int h, int w, PixelState reason) {
    for (int y = y0; y < y0 + h; ++y)
      for (int x = x0; x < x0 + w; ++x) dig(y, x, reason);
  }
  void fill(const PyramidKernels& kernels = pyramidKernels(usableIsas().back()), int threads = 1) {
    PlaneFillScratch scratch;
    fillFromPlanes(input(), disparity.view(), state.view(), scratch, kernels, threads);
  }
  PlaneFillInput input() const {
    return {.guide = guide.guide(),
            .left = left_gray.width() > 0 ? left_gray.view() : ImageView<const std::uint8_t>(),
            .right = right_gray.width() > 0 ? right_gray.view() : ImageView<const std::uint8_t>(),
            .right_disparity = right.view(),
            .scale = scale,
            .min_disparity = min_disparity,
            .max_disparity = max_disparity};
  }
  PixelState stateAt(int y, int x) const { return static_cast<PixelState>(state.at(y, x)); }

  int width, height;
  int scale = 4;
  float min_disparity = 0, max_disparity = 63;
  Padded<float> disparity, right;
  Padded<std::uint8_t> state, guide;
  Padded<std::uint8_t> left_gray{0, 0, 0}, right_gray{0, 0, 0};
};

// Gray views of a bare wall `level` px away, with texture of one gray value.
void paintBare(Scene& s, int level) {
  std::mt19937 random(12);
  std::vector<std::uint8_t> wall(static_cast<std::size_t>(s.width * s.height + level));
  for (std::uint8_t& v : wall) v = static_cast<std::uint8_t>(90 + random() % 3);
  const auto at = [&](int y, int x) { return wall[static_cast<std::size_t>(y * s.width + x)]; };
  s.left_gray = Padded<std::uint8_t>(s.width, s.height, 1).fill([&](int y, int x, int) { return at(y, x); });
  s.right_gray =
      Padded<std::uint8_t>(s.width, s.height, 1).fill([&](int y, int x, int) { return at(y, x + level); });
}

TEST(FillFromPlanes, HolesTakeThePlaneOfTheirSegment) {
  for (int scale : {1, 2, 4})
    for (int channels : {1, 3}) {
      Scene s(192, 96, channels);
      s.scale = scale;
      s.digBox(20, 10, 50, 60, PixelState::kMismatched);  // inside the left surface
      s.digBox(30, 80, 30, 40, PixelState::kAmbiguous);   // across the seam
      s.digBox(0, 150, 96, 42, PixelState::kOutOfRange);  // up to the border
      Scene before = s;
      s.fill();
      for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) {
          const bool was_hole = before.stateAt(y, x) != PixelState::kMeasured;
          ASSERT_EQ(s.stateAt(y, x), was_hole ? PixelState::kFilledPlane : PixelState::kMeasured)
              << "scale " << scale << " at y " << y << ", x " << x;
          // The planes level off 1 px beyond the disparities that support them.
          if (x < 150) {
            ASSERT_NEAR(s.disparity.at(y, x), truth(y, x), was_hole ? 0.05f : 0);
          }
        }
      ASSERT_TRUE(s.disparity.poisonIntact() && s.state.poisonIntact());
    }
}

TEST(FillFromPlanes, OutliersAmongTheSourcesDoNotBendThePlane) {
  Scene s;
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i)
    s.disparity.at(static_cast<int>(random() % 96), static_cast<int>(random() % 192)) =
        0.1f * (random() % 600);
  s.digBox(20, 20, 40, 40, PixelState::kSpeckle);
  s.fill();
  for (int y = 20; y < 60; ++y)
    for (int x = 20; x < 60; ++x) ASSERT_NEAR(s.disparity.at(y, x), truth(y, x), 0.15f) << y << ' ' << x;
}

TEST(FillFromPlanes, LevelsOffBeyondItsSupport) {
  Scene s(400, 64, 1);
  s.guide.fill([](int, int, int) { return std::uint8_t{80}; });
  s.disparity.fill([](int, int x, int) { return 10 + 0.1f * static_cast<float>(x); });
  s.digBox(0, 200, 64, 200, PixelState::kAmbiguous);
  s.fill();
  EXPECT_NEAR(s.disparity.at(30, 201), 30.1f, 0.05f);
  EXPECT_GT(s.disparity.at(30, 399), 29.9f);  // the last source's
  EXPECT_LT(s.disparity.at(30, 399), 31.0f);  // not 49.9
}

TEST(FillFromPlanes, LeavesWhatTheRightViewContradicts) {
  Scene s;
  s.digBox(20, 20, 40, 40, PixelState::kMismatched);
  for (int y = 20; y < 40; ++y)  // the right view sees far behind the upper half
    for (int x = 0; x < s.width; ++x) s.right.at(y, x) = 2;
  for (int y = 40; y < 60; ++y)  // and something nearer at the lower half: the hole may be hidden by it
    for (int x = 0; x < s.width; ++x) s.right.at(y, x) = 60;
  s.fill();
  for (int y = 20; y < 60; ++y)
    for (int x = 20; x < 60; ++x) {
      const bool expect_open = y < 40 && std::floor(static_cast<float>(x) - truth(y, x) + 0.5f) >= 0;
      ASSERT_EQ(s.stateAt(y, x), expect_open ? PixelState::kMismatched : PixelState::kFilledPlane)
          << y << ' ' << x;
      ASSERT_EQ(std::isnan(s.disparity.at(y, x)), expect_open);
    }
}

// A dark surface at 5 px, measured in the lower half; in the upper half only its first `band` columns are
// there, unmeasured, beside a bright one at 20 px.
Scene darkBand(int band) {
  Scene s;
  s.guide.fill([&](int y, int x, int) { return static_cast<std::uint8_t>(y >= 48 || x < band ? 60 : 190); });
  s.disparity.fill([](int y, int, int) { return y >= 48 ? 5.0f : 20.0f; });
  s.digBox(0, 0, 48, band, PixelState::kOutOfRange);
  return s;
}

TEST(FillFromPlanes, WhatTheRightViewsBorderCutsOffTakesNoPlaneThatLeavesTheSurfaceThere) {
  Scene inside = darkBand(24);  // the bright surface begins at column 4 of the right view: it ends there
  inside.fill();
  Scene border = darkBand(20);  // at column 0: it may go on, and the dark plane has no claim
  border.fill();
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 16; ++x) {
      ASSERT_EQ(inside.disparity.at(y, x), 5) << x << ' ' << y;
      ASSERT_EQ(border.stateAt(y, x), PixelState::kOutOfRange) << x << ' ' << y;
    }
}

TEST(FillFromPlanes, WhatNoPlaneClaimsBeyondTheRightViewsBorderContinuesLevelWithinItsSegment) {
  for (const bool is_right : {false, true}) {  // the right end is cut off where disparities are negative
    Scene s;
    s.min_disparity = -63;
    s.guide.fill([](int, int, int) { return std::uint8_t{100}; });
    const float d = is_right ? -20 : 20;
    s.disparity.fill([&](int y, int, int) { return y >= 30 ? 0.5f * d : d; });  // most of it lies farther off
    s.digBox(0, is_right ? 172 : 0, 24, 20, PixelState::kOutOfRange);
    s.fill();
    for (int y = 0; y < 24; ++y)
      for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(s.disparity.at(y, is_right ? 172 + i : i), d) << i << ' ' << y;
        ASSERT_EQ(s.stateAt(y, is_right ? 172 + i : i), PixelState::kFilledPlane);
      }
  }
}

TEST(FillFromPlanes, ABareWallTakesItsOwnLevelNotThatOfWhatStandsBeforeIt) {
  for (const bool has_views : {false, true}) {
    Scene s;
    s.guide.fill([](int, int, int) { return std::uint8_t{90}; });
    s.disparity.fill([](int, int, int) { return 30.0f; });
    s.digBox(0, 40, 96, 152, PixelState::kMismatched);  // what is left is what the wall's neighbour lent it
    if (has_views) paintBare(s, 11);
    s.fill();
    for (int y = 0; y < 96; ++y)
      for (int x = 40; x < 192; ++x)
        ASSERT_NEAR(s.disparity.at(y, x), has_views ? 11 : 30, 0.3f) << x << ' ' << y;
  }
}

TEST(FillFromPlanes, APlaneThatTheWallAgreesWithStaysAndMayCoverLittle) {
  for (const bool has_views : {false, true}) {
    Scene s;
    s.guide.fill([](int, int, int) { return std::uint8_t{90}; });
    const auto slanted = [](int y, int x) {
      return 11.2f - 0.001f * static_cast<float>(x) - 0.002f * static_cast<float>(y);
    };
    s.disparity.fill([&](int y, int x, int) { return slanted(y, x); });
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 192; ++x)
        if (y % 12 > 0 || x % 12 > 0) s.dig(y, x, PixelState::kMismatched);  // 0.7 % are left
    if (has_views) paintBare(s, 11);
    s.fill();
    for (int y = 1; y < 96; y += 6)
      for (int x = 1; x < 191; x += 6) {
        ASSERT_EQ(s.stateAt(y, x), has_views ? PixelState::kFilledPlane : PixelState::kMismatched);
        if (has_views) {
          ASSERT_NEAR(s.disparity.at(y, x), slanted(y, x), 0.02f) << x << ' ' << y;
        }
      }
  }
}

TEST(FillFromPlanes, FillsWithinTheRangeOnly) {
  Scene s;
  s.digBox(10, 10, 60, 60, PixelState::kOccluded);
  s.min_disparity = 18;
  s.max_disparity = 20;
  s.fill();
  int filled = 0;
  for (int y = 10; y < 70; ++y)
    for (int x = 10; x < 70; ++x) {
      if (std::abs(truth(y, x) - 18) < 0.1f || std::abs(truth(y, x) - 20) < 0.1f) continue;
      const bool inside = truth(y, x) > 18 && truth(y, x) < 20;
      ASSERT_EQ(s.stateAt(y, x), inside ? PixelState::kFilledPlane : PixelState::kOccluded) << y << ' ' << x;
      filled += inside;
    }
  EXPECT_GT(filled, 100);
}

TEST(FillFromPlanes, MaskedAndFilledPixelsAreNeitherSourcesNorFilled) {
  Scene s;
  s.digBox(20, 20, 40, 40, PixelState::kMismatched);
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; x += 3) {
      s.state.at(y, x) = value(x % 2 == 0 ? PixelState::kMasked : PixelState::kFilledInterpolated);
      s.disparity.at(y, x) = 1.0f + 50.0f * static_cast<float>(y % 2);  // misleading
    }
  const Scene before = s;
  s.fill();
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      if (x % 3 == 0) {
        ASSERT_EQ(s.state.at(y, x), before.state.at(y, x));
        ASSERT_EQ(s.disparity.at(y, x), before.disparity.at(y, x));
      } else {
        ASSERT_NEAR(s.disparity.at(y, x), truth(y, x), 0.05f);
      }
    }
}

TEST(FillFromPlanes, WithoutHolesOrWithoutSupportNothingChanges) {
  Scene whole;
  Scene random_depth;  // half of every segment is measured, but not as a plane
  Scene bare;          // nothing is measured
  std::mt19937 random(4);
  random_depth.disparity.fill([&](int, int, int) { return 0.01f * static_cast<float>(random() % 6000); });
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 192; ++x) {
      if (x % 2 == 1) random_depth.dig(y, x, PixelState::kMismatched);
      bare.dig(y, x, PixelState::kOccluded);
    }
  for (Scene* s : {&whole, &random_depth, &bare}) {
    const Scene before = *s;
    s->fill();
    EXPECT_TRUE(s->disparity.sameBytes(before.disparity));
    EXPECT_TRUE(s->state.sameBytes(before.state));
  }
}

Scene randomScene(int width, int height, int channels, int scale, unsigned seed) {
  Scene s(width, height, channels);
  s.scale = scale;
  std::mt19937 random(seed);
  const PixelState reasons[] = {PixelState::kOccluded, PixelState::kMismatched, PixelState::kAmbiguous,
                                PixelState::kMasked, PixelState::kMeasured};
  s.guide.fill([&](int y, int x, int) {
    return static_cast<std::uint8_t>((x / 40 + y / 30) % 3 * 80 + static_cast<int>(random() % 12));
  });
  s.disparity.fill(
      [&](int y, int x, int) { return truth(y, x) + 0.01f * static_cast<float>(random() % 50); });
  s.right.fill([&](int, int, int) { return random() % 2 == 0 ? kNan : static_cast<float>(random() % 40); });
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (random() % 3 == 0) s.dig(y, x, reasons[random() % 5]);
  paintBare(s, 17);
  return s;
}

TEST(FillFromPlanes, SameBytesForEveryThreadCountAndInstructionSet) {
  const std::pair<int, int> sizes[] = {{1, 1}, {7, 31}, {31, 7}, {33, 33}, {64, 65}, {65, 64}, {201, 119}};
  for (const auto& [width, height] : sizes)
    for (int scale : {1, 2, 4}) {
      const Scene original = randomScene(width, height, scale == 2 ? 1 : 3, scale, 6);
      Scene want = original;
      want.fill(pyramidKernels(Isa::kScalar), 1);
      EXPECT_TRUE(width * height < 1000 || !want.state.sameBytes(original.state));
      PlaneFillScratch scratch;  // serves all
      forEachSetting([&](const PyramidKernels& kernels, int threads) {
        Scene s = original;
        fillFromPlanes(s.input(), s.disparity.view(), s.state.view(), scratch, kernels, threads);
        ASSERT_TRUE(s.disparity.sameBytes(want.disparity)) << sizeText(width, height) << ", scale " << scale;
        ASSERT_TRUE(s.state.sameBytes(want.state)) << sizeText(width, height) << ", scale " << scale;
      });
    }
}

TEST(SegmentCells, CountEverySourceAndHoleOnce) {
  const std::pair<int, int> sizes[] = {{1, 1}, {7, 9}, {31, 8}, {33, 5}, {64, 64}, {65, 6}, {127, 30}};
  for (const auto& [width, height] : sizes)
    for (int scale : {1, 2, 3, 4}) {
      const Scene s = randomScene(width, height, 1, 1, 9);
      const int columns = scaledLength(width, scale), rows = scaledLength(height, scale);
      SegmentCells cells;
      Buffer<std::int32_t> labels;
      labels.resize(static_cast<std::size_t>(columns * rows));
      for (int i = 0; i < columns * rows; ++i) labels[static_cast<std::size_t>(i)] = i % 3 == 2 ? 0 : i % 3;
      forEachSetting([&](const PyramidKernels& kernels, int threads) {
        cells.count(s.disparity.view(), s.state.view(), columns, rows, kernels, threads);
        cells.group(labels, 3);
        std::vector<int> visits(static_cast<std::size_t>(width * height), 0);
        for (int segment = 0; segment < 3; ++segment)
          for (const SegmentCells::Cell c : cells.segment(segment)) {
            ASSERT_EQ(labels[static_cast<std::size_t>(c.y * columns + c.x)], segment);
            int sources = 0, holes = 0;
            cells.forEachPixel(c, [&](SegmentCells::Pixel p) {
              ++visits[static_cast<std::size_t>(p.y * width + p.x)];
              ASSERT_EQ(p.x * columns / width, c.x);
              ASSERT_EQ(p.y * rows / height, c.y);
              sources += isSource(s.disparity.at(p.y, p.x), s.state.at(p.y, p.x));
              holes += isHole(s.disparity.at(p.y, p.x), s.state.at(p.y, p.x));
            });
            ASSERT_EQ(cells.sources(c), sources) << sizeText(width, height) << ", scale " << scale;
            ASSERT_EQ(cells.holes(c), holes) << sizeText(width, height) << ", scale " << scale;
          }
        for (int v : visits) ASSERT_EQ(v, 1);
      });
    }
}

}  // namespace
}  // namespace pomona
