#include "pyramid/segment_match.h"

#include <numeric>
#include <vector>

#include "pyramid/scale.h"
#include "tests/pyramid_support.h"
#include "tests/reference/pyramid.h"

namespace pomona {
namespace {

constexpr int kLimit = 62;

TEST(LocalResidual, EqualsItsTwin) {
  std::mt19937 random(3);
  for (int width : {1, 2, 3, 5, 7, 31, 33, 255, 256, 257, 258, 600})
    for (int amplitude : {0, 3, 255}) {
      Padded<std::uint8_t> gray(width, 5, 99);
      gray.fill([&](int, int, int) { return static_cast<std::uint8_t>(random() % (amplitude + 1)); });
      reference::Map twin(width, 5);
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < width; ++x) twin.at(y, x) = gray.at(y, x);
      for (Isa isa : usableIsas())
        for (int limit : {0, kLimit, 127}) {
          Padded<std::int8_t> out(width, 1, 55);
          const std::uint8_t* const rows[5] = {&gray.at(0, 0), &gray.at(1, 0), &gray.at(2, 0), &gray.at(3, 0),
                                               &gray.at(4, 0)};
          pyramidKernels(isa).localResidual(rows, width, limit, &out.at(0, 0));
          for (int x = 0; x < width; ++x)
            ASSERT_EQ(out.at(0, x), reference::localResidual(twin, 2, x, limit))
                << name(isa) << ", width " << width << ", limit " << limit << ", x " << x;
          ASSERT_TRUE(out.poisonIntact()) << name(isa) << ", width " << width;
        }
    }
}

TEST(Correlate, AddsTheProductsOfEveryDisparity) {
  std::mt19937 random(4);
  const auto residual = [&] { return static_cast<std::int8_t>(static_cast<int>(random() % 181) - 90); };
  for (int n : {0, 1, 3, 4, 6, 16})
    for (int disparities : {1, 7, 31, 33, 64, 200}) {
      std::vector<std::int8_t> left(n), right(n + disparities);
      for (std::int8_t& v : left) v = random() % 4 == 0 ? 0 : residual();
      for (std::int8_t& v : right) v = residual();
      for (Isa isa : usableIsas()) {
        std::vector<std::int32_t> products(disparities + 1, 5), squares(disparities + 1, 6);
        pyramidKernels(isa).correlate(left.data(), right.data(), n, disparities, products.data(),
                                      squares.data());
        for (int d = 0; d < disparities; ++d) {
          int product = 5, square = 6;
          for (int i = 0; i < n; ++i) {
            const int b = right[i + d];
            product += left[i] * b;
            square += left[i] != 0 ? b * b : 0;
          }
          ASSERT_EQ(products[d], product) << name(isa) << ", n " << n << ", d " << d;
          ASSERT_EQ(squares[d], square) << name(isa) << ", n " << n << ", d " << d;
        }
        ASSERT_EQ(products[disparities], 5);
        ASSERT_EQ(squares[disparities], 6);
      }
    }
}

// Two bare walls side by side, each in front of one disparity; the right view has grain of its own.
struct Walls {
  static constexpr int kWidth = 203, kHeight = 97, kSeam = 120, kScale = 4;

  Walls(int left_disparity, int right_disparity, int texture, int grain) {
    std::mt19937 random(7);
    const auto noise = [&](int amplitude) {
      return static_cast<int>(random() % (2 * amplitude + 1)) - amplitude;
    };
    for (int y = 0; y < kHeight; ++y) {
      int wall[2 * kWidth];
      for (int& v : wall) v = noise(texture);
      for (int x = 0; x < kWidth; ++x) {
        left.at(y, x) = static_cast<std::uint8_t>((x < kSeam ? 100 : 160) + wall[x + kWidth / 2]);
        right.at(y, x) = 0;
      }
      for (int x = 0; x < kWidth; ++x) {  // what the right view's column shows
        const bool is_near = x + left_disparity < kSeam;
        const int from = x + (is_near ? left_disparity : right_disparity);
        right.at(y, x) =
            static_cast<std::uint8_t>((is_near ? 100 : 160) + wall[from + kWidth / 2] + noise(grain));
      }
    }
    const int columns = scaledLength(kWidth, kScale), rows = scaledLength(kHeight, kScale);
    labels.resize(static_cast<std::size_t>(columns * rows));
    for (int i = 0; i < columns * rows; ++i)
      labels[static_cast<std::size_t>(i)] = i % columns * kWidth / columns >= kSeam;
    const Padded<float> disparity = Padded<float>(kWidth, kHeight, 0).fill([](int, int, int) { return 1; });
    const Padded<std::uint8_t> state = Padded<std::uint8_t>(kWidth, kHeight, 0);
    cells.count(disparity.view(), state.view(), columns, rows, pyramidKernels(Isa::kScalar), arena, 1);
    cells.group(labels.data(), 2);
  }
  Segment wall(int i) const { return {cells.segment(i), cells, labels.data()}; }
  SegmentMatch prepared(int min_disparity, int disparities, Isa isa = usableIsas().back(),
                        int threads = 1) const {
    SegmentMatch match;
    match.prepare(left.view(), right.view(), min_disparity, disparities, pyramidKernels(isa), arena);
    for (int i = 0; i < 2; ++i) match.announce(wall(i));
    match.readAnnounced(threads);
    return match;
  }
  // At least 4 px from the seam, in whole cells.
  bool isInner(int y, int x, int wall) const {
    const int columns = scaledLength(kWidth, kScale);
    const auto label = [&](int column) {
      return labels[static_cast<std::size_t>(std::clamp(column, 0, columns - 1))];
    };
    (void)y;
    const int column = x * columns / kWidth;
    return label(column - 2) == wall && label(column) == wall && label(column + 2) == wall;
  }

  Padded<std::uint8_t> left{kWidth, kHeight, 3}, right{kWidth, kHeight, 3};
  std::vector<std::int32_t> labels;
  mutable Arena arena;
  SegmentCells cells;
};

TEST(SegmentMatch, FindsTheLevelOfWallsWhoseTextureIsBelowTheGrain) {
  for (const auto& [near, far, low] :
       {std::array{12, 5, 0}, std::array{-4, -17, -30}, std::array{9, 2, -3}}) {
    const Walls walls(near, far, 1, 2);
    const SegmentMatch match = walls.prepared(low, 40);
    for (int i = 0; i < 2; ++i) {
      const auto level = match.levelOf(walls.wall(i));
      ASSERT_TRUE(level) << near << ' ' << far << ", wall " << i;
      EXPECT_NEAR(level->disparity, i == 0 ? near : far, 0.3f);
    }
  }
}

TEST(SegmentMatch, ScoresEqualTheirTwins) {
  const Walls walls(12, 5, 1, 1);
  const SegmentMatch match = walls.prepared(0, 40);
  reference::Map left(Walls::kWidth, Walls::kHeight), right = left;
  for (int y = 0; y < Walls::kHeight; ++y)
    for (int x = 0; x < Walls::kWidth; ++x) {
      left.at(y, x) = walls.left.at(y, x);
      right.at(y, x) = walls.right.at(y, x);
    }
  for (int i = 0; i < 2; ++i) {
    const auto inner = [&](int y, int x) { return walls.isInner(y, x, i); };
    const auto level = match.levelOf(walls.wall(i));
    ASSERT_TRUE(level);
    std::vector<double> scores;
    for (int d = 0; d < 40; ++d)
      scores.push_back(
          reference::residualCorrelation(left, right, kLimit, inner, [&](int, int) { return d; }));
    EXPECT_DOUBLE_EQ(level->score, *std::max_element(scores.begin(), scores.end()));

    const SegmentCells::Pixel origin = walls.wall(i).origin();
    const PlaneFit slanted = {{0.1f, -0.03f, 6}, 30, 4, 14};
    const auto plane = [&](int y, int x) {
      const double d =
          0.1f * static_cast<float>(x - origin.x) + -0.03f * static_cast<float>(y - origin.y) + 6;
      return static_cast<int>(std::floor(std::clamp(d, 3.0, 15.0) + 0.5));
    };
    EXPECT_NEAR(match.scoreOf(walls.wall(i), slanted),
                reference::residualCorrelation(left, right, kLimit, inner, plane), 1e-3 * level->score);
  }
}

TEST(SegmentMatch, NothingStandsOutWhereNothingMatches) {
  Walls walls(12, 5, 1, 1);
  std::mt19937 random(8);
  walls.right.fill([&](int, int, int) { return static_cast<std::uint8_t>(100 + random() % 3); });
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(walls.prepared(0, 40).levelOf(walls.wall(i))) << i;
  walls.right.fill([](int, int, int) { return 100; });
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(walls.prepared(0, 40).levelOf(walls.wall(i))) << i;
  EXPECT_FALSE(Walls(12, 5, 1, 1).prepared(0, 8).levelOf(walls.wall(0)));  // too few to compare with
}

// What else is in the right view would win there by chance.
TEST(SegmentMatch, NothingStandsOutOfWhatLeavesTheRightView) {
  const Walls inside(40, 5, 1, 1), outside(70, 5, 1, 1);  // the wall is 120 px wide
  const auto level = inside.prepared(0, 140).levelOf(inside.wall(0));
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->disparity, 40, 0.3f);
  EXPECT_FALSE(outside.prepared(0, 140).levelOf(outside.wall(0)));
  EXPECT_FALSE(inside.prepared(0, 250).levelOf(inside.wall(0)));  // unknown from 105 up
}

TEST(SegmentMatch, StrongTextureOfAnotherSurfaceDoesNotCount) {
  Walls walls(12, 5, 1, 1);
  std::mt19937 random(9);
  for (int y = 0; y < Walls::kHeight;
       ++y)  // bold stripes before the wall, farther right in the left view by 30
    for (int x = 60; x < 80; ++x) {
      const auto bold = static_cast<std::uint8_t>(random() % 2 * 200);
      walls.left.at(y, x) = bold;
      walls.right.at(y, x - 30) = bold;
    }
  const auto level = walls.prepared(0, 40).levelOf(walls.wall(0));
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->disparity, 12, 0.3f);
}

TEST(SegmentMatch, SameOnEveryInstructionSetAndThreadCount) {
  const Walls walls(12, 5, 1, 1);
  const auto want = walls.prepared(-5, 40, Isa::kScalar).levelOf(walls.wall(0));
  ASSERT_TRUE(want);
  for (Isa isa : usableIsas())
    for (int threads : {1, 3}) {
      const auto level = walls.prepared(-5, 40, isa, threads).levelOf(walls.wall(0));
      ASSERT_TRUE(level) << name(isa);
      EXPECT_EQ(level->disparity, want->disparity) << name(isa);
      EXPECT_EQ(level->score, want->score) << name(isa);
      EXPECT_EQ(level->deviation, want->deviation) << name(isa);
    }
}

}  // namespace
}  // namespace pomona
