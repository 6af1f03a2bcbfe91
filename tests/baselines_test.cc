// SSD, NCC and ASW against their twins, and what all of them share.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "baselines/asw.h"
#include "baselines/asw_views.h"
#include "baselines/ncc.h"
#include "baselines/ssd.h"
#include "baselines/window_products.h"
#include "pomona/pixel_state.h"
#include "reference/windows.h"

namespace pomona {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 7};

struct Pair {
  cv::Mat left, right;
};

/// Two views of noise, shifted by about 3 pixels, as regions of larger images.
Pair randomPair(int width, int height, int type, std::uint32_t seed) {
  cv::Mat wide(height + 4, width + 14, type), noise(height + 4, width + 14, type);
  cv::RNG random(seed);
  const double largest = CV_MAT_DEPTH(type) == CV_8U ? 256 : 4096;
  random.fill(wide, cv::RNG::UNIFORM, 0, largest);
  random.fill(noise, cv::RNG::UNIFORM, 0, largest / 16);
  return {wide(cv::Rect(3, 2, width, height)), cv::Mat(wide + noise)(cv::Rect(6, 2, width, height))};
}

Pair constantPair(int width, int height, int type, double value) {
  return {cv::Mat(height, width, type, cv::Scalar::all(value)),
          cv::Mat(height, width, type, cv::Scalar::all(value))};
}

std::size_t countOf(const WindowMaps& maps) {
  return static_cast<std::size_t>(maps.disparity.width()) * static_cast<std::size_t>(maps.disparity.height());
}

/// Whether the maps hold winners of `volume`: the cost of what was picked may exceed the smallest by
/// `tolerance` of it, no more. Costs that differ by less are a draw for a float.
void expectWinners(const WindowMaps& maps, const reference::CostVolume& volume, SearchRange range,
                   double tolerance) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  for (int y = 0; y < height; ++y) {
    const auto& costs = volume[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x) {
      const auto& of_pixel = costs[static_cast<std::size_t>(x)];
      const double best = *std::min_element(of_pixel.begin(), of_pixel.end());
      const float d = maps.disparity.row(y)[x];
      const auto state = static_cast<PixelState>(maps.state.row(y)[x]);
      ASSERT_EQ(std::isnan(d), std::isinf(best)) << x << ", " << y;
      ASSERT_EQ(state, std::isnan(d) ? PixelState::kOutOfRange : PixelState::kMeasured);
      if (std::isnan(d)) continue;
      ASSERT_EQ(d, std::round(d));
      ASSERT_LE(of_pixel.at(static_cast<std::size_t>(d - static_cast<float>(range.min))),
                best * (1 + tolerance) + tolerance)
          << x << ", " << y << ": " << d;
    }
    for (int q = 0; q < width; ++q) {
      double best = std::numeric_limits<double>::infinity();
      const auto costOf = [&](int d) {
        const int x = q + d;
        return x < 0 || x >= width
                   ? best
                   : costs[static_cast<std::size_t>(x)][static_cast<std::size_t>(d - range.min)];
      };
      for (int d = range.min; d < range.min + range.count; ++d) best = std::min(best, costOf(d));
      const float d = maps.right_disparity.row(y)[q];
      ASSERT_EQ(std::isnan(d), std::isinf(best)) << q << ", " << y;
      if (!std::isnan(d)) {
        ASSERT_LE(costOf(static_cast<int>(d)), best * (1 + tolerance) + tolerance) << q << ", " << y;
      }
    }
  }
}

void expectSameBytes(const WindowMaps& a, const WindowMaps& b) {
  for (int y = 0; y < a.disparity.height(); ++y) {
    const auto bytes = static_cast<std::size_t>(a.disparity.width()) * sizeof(float);
    ASSERT_EQ(std::memcmp(a.disparity.row(y), b.disparity.row(y), bytes), 0) << "row " << y;
    ASSERT_EQ(std::memcmp(a.right_disparity.row(y), b.right_disparity.row(y), bytes), 0) << "row " << y;
    ASSERT_EQ(std::memcmp(a.confidence.row(y), b.confidence.row(y), bytes), 0) << "row " << y;
  }
  ASSERT_GT(countOf(a), 0u);
}

struct Case {
  int width, height, type;
  SearchRange range;
};
const Case kCases[] = {{1, 1, CV_8UC1, {0, 1}},    {7, 5, CV_8UC3, {0, 7}},    {31, 9, CV_8UC1, {-4, 9}},
                       {33, 6, CV_16UC1, {0, 16}}, {12, 30, CV_16UC3, {2, 5}}, {65, 11, CV_8UC3, {-9, 12}},
                       {20, 4, CV_8UC1, {8, 12}}};

std::string describe(const Case& c) {
  return std::to_string(c.width) + "x" + std::to_string(c.height) + " of " + cv::typeToString(c.type) + ", " +
         std::to_string(c.range.count) + " disparities from " + std::to_string(c.range.min);
}

template <typename Match, typename Cost>
void expectLikeTwin(Match match, Cost cost, double tolerance) {
  for (const Case& c : kCases)
    for (const bool flat : {false, true}) {
      SCOPED_TRACE(describe(c) + (flat ? ", constant" : ""));
      const Pair pair =
          flat ? constantPair(c.width, c.height, c.type, 200) : randomPair(c.width, c.height, c.type, 5);
      for (const int radius : {0, 1, 4}) {
        SCOPED_TRACE("radius " + std::to_string(radius));
        const auto volume =
            reference::costVolume(c.width, c.height, c.range.min, c.range.count,
                                  [&](int y, int x, int d) { return cost(pair, radius, y, x, d); });
        const WindowMaps once = match(pair, radius, c.range, WinnerPosition::kWhole, 1);
        expectWinners(once, volume, c.range, tolerance);
        if (::testing::Test::HasFatalFailure()) return;
        for (const int threads : kThreadCounts) {
          SCOPED_TRACE("threads " + std::to_string(threads));
          expectSameBytes(match(pair, radius, c.range, WinnerPosition::kWhole, threads), once);
        }
      }
    }
}

TEST(Ssd, PicksTheWinnersOfItsTwin) {
  expectLikeTwin(
      [](const Pair& pair, int radius, SearchRange range, WinnerPosition position, int threads) {
        return matchSsd(pair.left, pair.right, radius, range, position, threads);
      },
      [](const Pair& pair, int radius, int y, int x, int d) {
        return reference::ssd(pair.left, pair.right, radius, y, x, d);
      },
      2e-7);
}

TEST(Ncc, PicksTheWinnersOfItsTwin) {
  expectLikeTwin(
      [](const Pair& pair, int radius, SearchRange range, WinnerPosition position, int threads) {
        return matchNcc(pair.left, pair.right, radius, range, position, threads);
      },
      [](const Pair& pair, int radius, int y, int x, int d) {
        return reference::ncc(pair.left, pair.right, radius, y, x, d);
      },
      1e-6);
}

TEST(Ncc, GainAndOffsetDoNotMatter) {
  const Pair pair = randomPair(40, 20, CV_8UC1, 3);
  cv::Mat dimmed;
  pair.right.convertTo(dimmed, CV_16U, 3, 100);
  cv::Mat left;
  pair.left.convertTo(left, CV_16U);
  const WindowMaps maps = matchNcc(left, dimmed, 3, {0, 8}, WinnerPosition::kWhole, 1);
  for (int y = 0; y < 20; ++y)
    for (int x = 12; x < 36; ++x) EXPECT_EQ(maps.disparity.row(y)[x], 3);
}

TEST(Windows, TheLargestSumsDoNotOverflow) {
  // 63x63 windows of the largest differences, in every type.
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3}) {
    SCOPED_TRACE(cv::typeToString(type));
    const double largest = CV_MAT_DEPTH(type) == CV_8U ? 255 : 65535;
    cv::Mat left(10, 90, type, cv::Scalar::all(largest)), right(10, 90, type, cv::Scalar::all(0));
    left.colRange(0, 40).setTo(cv::Scalar::all(0));
    right.colRange(35, 90).setTo(cv::Scalar::all(largest));  // an edge, shifted by 5
    for (const bool ncc : {false, true}) {
      const auto match = ncc ? matchNcc : matchSsd;
      const WindowMaps maps = match(left, right, kLargestWindowRadius, {0, 10}, WinnerPosition::kWhole, 2);
      EXPECT_EQ(maps.disparity.row(5)[40], 5) << ncc;
      EXPECT_EQ(maps.right_disparity.row(5)[35], 5) << ncc;
    }
  }
  EXPECT_THROW(matchSsd(cv::Mat(9, 9, CV_8U), cv::Mat(9, 9, CV_8U), kLargestWindowRadius + 1, {0, 4},
                        WinnerPosition::kWhole, 1),
               std::invalid_argument);
}

TEST(Windows, AParabolaRefinesBelowThePixel) {
  // A smooth wave, shifted by 4.3 pixels.
  cv::Mat left(12, 100, CV_16U), right(12, 100, CV_16U);
  const auto wave = [](double x) { return 30000 + 20000 * std::sin(x / 5); };
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 100; ++x) {
      left.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(wave(x));
      right.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(wave(x + 4.3));
    }
  const WindowMaps maps = matchSsd(left, right, 4, {0, 10}, WinnerPosition::kParabola, 1);
  for (int x = 20; x < 90; ++x) EXPECT_NEAR(maps.disparity.row(6)[x], 4.3f, 0.07f) << x;
}

TEST(Windows, ConfidenceTellsAClearWinnerFromADraw) {
  const Pair noise = randomPair(60, 20, CV_8UC1, 8);
  EXPECT_GT(matchSsd(noise.left, noise.right, 3, {0, 8}, WinnerPosition::kWhole, 1).confidence.row(10)[30],
            0.9f);
  const Pair flat = constantPair(60, 20, CV_8UC1, 90);
  EXPECT_EQ(matchSsd(flat.left, flat.right, 3, {0, 8}, WinnerPosition::kWhole, 1).confidence.row(10)[30], 0);
}

cv::Mat labOf(const cv::Mat& image, double scale) {
  cv::Mat lab(image.size(), CV_64FC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      std::array<float, 3> bgr;
      for (int c = 0; c < 3; ++c)
        bgr[static_cast<std::size_t>(c)] = static_cast<float>(scale * reference::valueAt(image, y, x, c));
      const auto converted = labFromBgr(bgr);
      lab.at<cv::Vec3d>(y, x) = {converted[0], converted[1], converted[2]};
    }
  return lab;
}

/// 8-bit units per unit of a 16-bit pair: its bits in use, at least 8, become 8.
double scaleOf(const Pair& pair) {
  double largest_left, largest_right, range = 256;
  cv::minMaxLoc(pair.left.reshape(1), nullptr, &largest_left);
  cv::minMaxLoc(pair.right.reshape(1), nullptr, &largest_right);
  while (range <= std::max(largest_left, largest_right)) range *= 2;
  return 256 / range;
}

TEST(Asw, LabIsOpenCvs) {
  cv::Mat colors(1, 6, CV_32FC3), lab;
  const float bgr[6][3] = {{0, 0, 0},  {255, 255, 255}, {255, 0, 0},
                           {10, 3, 7}, {30, 140, 220},  {128, 128, 128}};
  for (int i = 0; i < 6; ++i) colors.at<cv::Vec3f>(0, i) = cv::Vec3f(bgr[i][0], bgr[i][1], bgr[i][2]) / 255;
  cv::cvtColor(colors, lab, cv::COLOR_BGR2Lab);
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(labFromBgr({bgr[i][0], bgr[i][1], bgr[i][2]})[static_cast<std::size_t>(c)],
                  lab.at<cv::Vec3f>(0, i)[c], 0.3)  // OpenCV interpolates in a table
          << i << ", " << c;
}

TEST(Asw, PicksTheWinnersOfItsTwinOnEveryInstructionSetAndNumberOfThreads) {
  for (const Case& c : kCases)
    for (const bool flat : {false, true}) {
      SCOPED_TRACE(describe(c) + (flat ? ", constant" : ""));
      const Pair pair =
          flat ? constantPair(c.width, c.height, c.type, 200) : randomPair(c.width, c.height, c.type, 5);
      const double scale = c.type == CV_8UC1 || c.type == CV_8UC3 ? 1 : scaleOf(pair);
      const cv::Mat lab_left = labOf(pair.left, scale), lab_right = labOf(pair.right, scale);
      for (const int radius : {1, 5}) {
        SCOPED_TRACE("radius " + std::to_string(radius));
        const AswOptions options{
            .radius = radius, .color_gamma = 7, .proximity_gamma = 3.5f, .truncation = 40};
        const auto volume =
            reference::costVolume(c.width, c.height, c.range.min, c.range.count, [&](int y, int x, int d) {
              return reference::asw(pair.left, pair.right, lab_left, lab_right, scale, {radius, 7, 3.5, 40},
                                    y, x, d);
            });
        const auto match = [&](Isa isa, int threads) {
          return matchAsw(pair.left, pair.right, options, c.range, WinnerPosition::kWhole, isa, threads);
        };
        const WindowMaps once = match(Isa::kScalar, 1);
        expectWinners(once, volume, c.range, 1e-5);
        if (::testing::Test::HasFatalFailure()) return;
        for (const Isa isa : usableIsas())
          for (const int threads : kThreadCounts) {
            SCOPED_TRACE(std::string(name(isa)) + ", threads " + std::to_string(threads));
            expectSameBytes(match(isa, threads), once);
          }
      }
    }
}

TEST(Asw, RefusesParametersThatMeanNothing) {
  const cv::Mat view(9, 9, CV_8U, cv::Scalar(0));
  for (const AswOptions& bad :
       {AswOptions{.radius = 0}, AswOptions{.radius = kLargestAswRadius + 1}, AswOptions{.color_gamma = 0},
        AswOptions{.proximity_gamma = -1}, AswOptions{.truncation = 0}})
    EXPECT_THROW(matchAsw(view, view, bad, {0, 4}, WinnerPosition::kWhole, Isa::kScalar, 1),
                 std::invalid_argument);
}

}  // namespace
}  // namespace pomona
