#include "pyramid/laplacian.h"

#include "pyramid/fusion.h"
#include "tests/pyramid_support.h"
#include "tests/reference/pyramid.h"

namespace pomona {
namespace {

const std::vector<std::pair<int, int>> kSizes = {{1, 1},   {2, 1},   {1, 9},   {2, 2},   {7, 3},
                                                 {31, 18}, {33, 32}, {64, 47}, {65, 65}, {130, 21}};

Padded<float> randomMap(int width, int height, unsigned seed, float scale) {
  std::mt19937 random(seed);
  Padded<float> map(width, height, 1e30f);
  map.fill([&](int, int, int) { return static_cast<float>(random() % 4096) * (scale / 4096.0f); });
  return map;
}

reference::Map toTwin(ImageView<const float> in) {
  reference::Map map(in.width, in.height);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) map.at(y, x) = in.at(y, x);
  return map;
}

void expectNear(ImageView<const float> actual, const reference::Map& expected, double tolerance) {
  ASSERT_EQ(actual.width, expected.width);
  ASSERT_EQ(actual.height, expected.height);
  for (int y = 0; y < actual.height; ++y)
    for (int x = 0; x < actual.width; ++x)
      ASSERT_NEAR(actual.at(y, x), expected.at(y, x), tolerance) << "at y " << y << ", x " << x;
}

TEST(GaussianPyramid, MatchesItsTwinOnEveryLevel) {
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(sizeText(width, height));
    const Padded<float> map = randomMap(width, height, 1, 1000);
    const std::vector<reference::Map> twin = reference::gaussianPyramid(toTwin(map.view()), 6);
    Arena arena;
    GaussianPyramid pyramid;
    forEachSetting([&](const PyramidKernels& kernels, int threads) {
      const Arena::Scope scope(arena);
      pyramid.build(map.view(), 6, kernels, arena, threads);
      ASSERT_EQ(pyramid.levels(), static_cast<int>(twin.size()));
      for (int i = 0; i < pyramid.levels(); ++i) expectNear(pyramid.level(i), twin[i], 5e-4);
    });
  }
}

TEST(LaplacianPyramid, MatchesItsTwinOnEveryLevel) {
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(sizeText(width, height));
    const Padded<float> map = randomMap(width, height, 2, 1000);
    const std::vector<reference::Map> twin = reference::laplacianPyramid(toTwin(map.view()), 6);
    Arena arena;
    LaplacianPyramid pyramid;
    forEachSetting([&](const PyramidKernels& kernels, int threads) {
      const Arena::Scope scope(arena);
      pyramid.build(map.view(), 6, kernels, arena, threads);
      ASSERT_EQ(pyramid.levels(), static_cast<int>(twin.size()));
      for (int i = 0; i < pyramid.levels(); ++i) expectNear(pyramid.level(i), twin[i], 5e-4);
    });
  }
}

TEST(LaplacianPyramid, ReconstructsPerfectlyAndIsTheSameOnEverySetting) {
  for (const auto& [width, height] : kSizes)
    for (int levels : {1, 2, 6, kMaxPyramidLevels}) {
      SCOPED_TRACE(sizeText(width, height) + ", levels " + std::to_string(levels));
      const Padded<float> map = randomMap(width, height, 3, 1000);
      Arena arena;
      LaplacianPyramid pyramid;
      Padded<float> first(width, height, -7.0f);
      pyramid.build(map.view(), levels, pyramidKernels(Isa::kScalar), arena, 1);
      pyramid.collapse(first.view(), pyramidKernels(Isa::kScalar), arena, 1);
      expectNear(first.view(), toTwin(map.view()), 1e-4);
      forEachSetting([&](const PyramidKernels& kernels, int threads) {
        Padded<float> out(width, height, -7.0f);
        const Arena::Scope scope(arena);
        pyramid.build(map.view(), levels, kernels, arena, threads);
        pyramid.collapse(out.view(), kernels, arena, threads);
        EXPECT_TRUE(out.sameBytes(first));
      });
    }
}

TEST(LaplacianPyramid, BandsOfAConstantAreZero) {
  Padded<float> map(37, 22, 0.0f);
  map.fill([](int, int, int) { return 640.0f; });
  Arena arena;
  LaplacianPyramid pyramid;
  pyramid.build(std::as_const(map).view(), 4, pyramidKernels(usableIsas().back()), arena, 1);
  ASSERT_EQ(pyramid.levels(), 4);
  for (int i = 0; i < 3; ++i)
    expectNear(pyramid.level(i), reference::Map(pyramid.level(i).width, pyramid.level(i).height, 0), 0);
  expectNear(pyramid.level(3), reference::Map(5, 3, 640), 0);
}

TEST(FuseEqual, IsTheAverageForAnyNumberOfLevels) {
  for (const auto& [width, height] : kSizes)
    for (int levels : {1, 3, 6}) {
      SCOPED_TRACE(sizeText(width, height) + ", levels " + std::to_string(levels));
      const Padded<float> a = randomMap(width, height, 4, 200), b = randomMap(width, height, 5, 200);
      reference::Map average(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) average.at(y, x) = 0.5 * (double{a.at(y, x)} + b.at(y, x));
      Arena scratch;
      Padded<float> first(width, height, -7.0f);
      fuseEqual(a.view(), b.view(), levels, first.view(), scratch, pyramidKernels(Isa::kScalar), 1);
      expectNear(first.view(), average, 1e-4);
      forEachSetting([&](const PyramidKernels& kernels, int threads) {
        Padded<float> out(width, height, -7.0f);
        fuseEqual(a.view(), b.view(), levels, out.view(), scratch, kernels, threads);
        EXPECT_TRUE(out.sameBytes(first));
      });
    }
}

}  // namespace
}  // namespace pomona
