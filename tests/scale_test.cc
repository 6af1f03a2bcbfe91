#include "pyramid/scale.h"

#include "tests/pyramid_support.h"
#include "tests/reference/pyramid.h"

namespace pomona {
namespace {

struct Sizes {
  int in_w, in_h, out_w, out_h;
  std::string text() const { return sizeText(in_w, in_h) + " to " + sizeText(out_w, out_h); }
};
const std::vector<Sizes> kSizes = {{1, 1, 1, 1},     {7, 5, 2, 1},    {31, 9, 8, 2},   {33, 33, 9, 7},
                                   {64, 48, 16, 12}, {65, 40, 13, 8}, {67, 45, 17, 9}, {129, 31, 26, 7},
                                   {50, 30, 50, 30}, {9, 6, 20, 13}};

TEST(ScaledLength, RoundsUpAndIsNeverZero) {
  EXPECT_EQ(scaledLength(1280, 4), 320);
  EXPECT_EQ(scaledLength(1281, 4), 321);
  EXPECT_EQ(scaledLength(3, 5), 1);
  EXPECT_EQ(scaledLength(1, 1), 1);
}

template <typename T>
void expectAreaMeans(const Padded<T>& in, const Image<T>& out, const Sizes& s) {
  ASSERT_EQ(out.width(), s.out_w * in.channels());
  ASSERT_EQ(out.height(), s.out_h);
  for (int y = 0; y < s.out_h; ++y)
    for (int x = 0; x < s.out_w; ++x)
      for (int c = 0; c < in.channels(); ++c) {
        const auto value = [&](int i, int j) { return std::int64_t{in.at(i, j, c)}; };
        ASSERT_EQ(out.row(y)[x * in.channels() + c],
                  reference::areaMean(value, s.in_w, s.in_h, s.out_w, s.out_h, y, x))
            << s.text() << " at y " << y << ", x " << x << ", channel " << c << " of " << in.channels();
      }
}

TEST(AreaDownscale, IsTheExactMeanOfEightBitImages) {
  for (const Sizes& s : kSizes)
    for (int channels : {1, 3})
      for (bool extreme : {false, true}) {
        std::mt19937 random(7);
        Padded<std::uint8_t> in(s.in_w, s.in_h, 99, channels);
        in.fill([&](int, int, int) {
          return static_cast<std::uint8_t>(extreme ? 255 * (random() % 2) : random());
        });
        Arena scratch;
        Image<std::uint8_t> out;
        forEachSetting([&](const PyramidKernels& kernels, int threads) {
          out.resize(s.out_w * channels, s.out_h);
          areaDownscale(in.guide(), out.view(), scratch, kernels, threads);
          expectAreaMeans(in, out, s);
        });
      }
}

TEST(AreaDownscale, IsTheExactMeanOfSixteenBitImages) {
  for (const Sizes& s : kSizes)
    for (bool white : {false, true}) {
      std::mt19937 random(8);
      Padded<std::uint16_t> in(s.in_w, s.in_h, 99);
      in.fill([&](int, int, int) { return static_cast<std::uint16_t>(white ? 65535 : random()); });
      Arena scratch;
      Image<std::uint16_t> out;
      forEachSetting([&](const PyramidKernels& kernels, int threads) {
        out.resize(s.out_w, s.out_h);
        areaDownscale(std::as_const(in).view(), out.view(), scratch, kernels, threads);
        expectAreaMeans(in, out, s);
      });
    }
}

TEST(AreaDownscale, AveragesBoxesForWholeRatios) {
  Padded<std::uint8_t> in(12, 8, 0);
  std::mt19937 random(9);
  in.fill([&](int, int, int) { return static_cast<std::uint8_t>(random()); });
  Arena scratch;
  Image<std::uint8_t> out(3, 2);
  areaDownscale(in.guide(), out.view(), scratch, pyramidKernels(Isa::kScalar), 1);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      int sum = 0;
      for (int i = 0; i < 16; ++i) sum += in.at(4 * y + i / 4, 4 * x + i % 4);
      EXPECT_EQ(out.row(y)[x], (sum + 8) / 16);
    }
}

TEST(AreaDownscale, DoesNotOverflowOnTallWhiteImages) {
  const int height = 65535;
  Padded<std::uint16_t> in(3, height, 0);
  in.fill([](int, int, int) { return std::uint16_t{65535}; });
  Arena scratch;
  Image<std::uint16_t> out(2, 1);
  areaDownscale(std::as_const(in).view(), out.view(), scratch, pyramidKernels(usableIsas().back()), 1);
  EXPECT_EQ(out.row(0)[0], 65535);
  EXPECT_EQ(out.row(0)[1], 65535);
}

// Float sums of 16 products of values up to 200: 2e-4 is ten roundings.
void expectBicubic(const Padded<float>& in, const Sizes& s) {
  reference::Map twin(s.in_w, s.in_h);
  for (int y = 0; y < s.in_h; ++y)
    for (int x = 0; x < s.in_w; ++x) twin.at(y, x) = in.at(y, x);
  Arena scratch;
  Padded<float> first(s.out_w, s.out_h, -7.0f);
  bicubicUpscale(in.view(), first.view(), scratch, pyramidKernels(Isa::kScalar), 1);
  for (int y = 0; y < s.out_h; ++y)
    for (int x = 0; x < s.out_w; ++x) {
      const double expected = reference::bicubic(twin, s.out_w, s.out_h, y, x);
      ASSERT_EQ(std::isnan(first.at(y, x)), std::isnan(expected)) << s.text() << " at y " << y << ", x " << x;
      if (!std::isnan(expected)) {
        ASSERT_NEAR(first.at(y, x), expected, 2e-4) << s.text() << " at y " << y << ", x " << x;
      }
    }
  forEachSetting([&](const PyramidKernels& kernels, int threads) {
    Padded<float> out(s.out_w, s.out_h, -7.0f);
    bicubicUpscale(in.view(), out.view(), scratch, kernels, threads);
    ASSERT_TRUE(out.poisonIntact()) << s.text();
    for (int y = 0; y < s.out_h; ++y)
      for (int x = 0; x < s.out_w; ++x) {
        const float a = out.at(y, x), b = first.at(y, x);
        ASSERT_TRUE((std::isnan(a) && std::isnan(b)) ||
                    std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b))
            << s.text() << " at y " << y << ", x " << x << ": " << a << " against " << b;
      }
  });
}

TEST(BicubicUpscale, MatchesItsTwinWithAndWithoutHoles) {
  for (const Sizes& s : kSizes)
    for (int hole_percent : {0, 5, 60, 100}) {
      SCOPED_TRACE("holes " + std::to_string(hole_percent) + " %");
      std::mt19937 random(10);
      Padded<float> in(s.out_w, s.out_h, 1e30f);
      in.fill([&](int, int, int) {
        return static_cast<int>(random() % 100) < hole_percent ? kNan
                                                               : static_cast<float>(random() % 2000) * 0.1f;
      });
      expectBicubic(in, {s.out_w, s.out_h, s.in_w, s.in_h});
    }
}

TEST(BicubicUpscale, KeepsConstantsAndCentredRamps) {
  Padded<float> constant(9, 7, 0.0f), ramp(9, 7, 0.0f);
  constant.fill([](int, int, int) { return 12.5f; });
  ramp.fill([](int, int x, int) { return 4.0f * (static_cast<float>(x) + 0.5f); });
  Arena scratch;
  Padded<float> out(36, 28, 0.0f);
  bicubicUpscale(constant.view(), out.view(), scratch, pyramidKernels(Isa::kScalar), 1);
  for (int x = 0; x < 36; ++x) EXPECT_NEAR(out.at(13, x), 12.5f, 1e-5);
  bicubicUpscale(ramp.view(), out.view(), scratch, pyramidKernels(Isa::kScalar), 1);
  for (int x = 8; x < 28; ++x) EXPECT_NEAR(out.at(13, x), static_cast<float>(x) + 0.5f, 1e-4) << x;
}

TEST(ScaleDisparity, MultipliesAndKeepsNan) {
  Padded<float> map(33, 20, -1.0f);
  map.fill([](int y, int x, int) { return y == 3 ? kNan : static_cast<float>(x); });
  scaleDisparity(map.view(), 4.25f, 3);
  EXPECT_TRUE(map.poisonIntact());
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 33; ++x) {
      if (y == 3)
        EXPECT_TRUE(std::isnan(map.at(y, x)));
      else
        EXPECT_EQ(map.at(y, x), 4.25f * static_cast<float>(x));
    }
}

}  // namespace
}  // namespace pomona
