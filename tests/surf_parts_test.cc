// The parts of SURF against their definitions, pixel by pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "plugins/common/surf/box_hessian.h"
#include "plugins/common/surf/descriptor.h"
#include "plugins/common/surf/haar.h"
#include "plugins/common/surf/orientation.h"
#include "tests/surf_support.h"

namespace pomona {
namespace {

cv::Mat noise(int width, int height) {
  cv::Mat image(height, width, CV_8U);
  cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

IntegralImage integralOf(const cv::Mat& image) {
  return IntegralImage({image.ptr(), image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step1())});
}

// Weights of the paper's figure 2, for any lobe.
int weightYy(int lobe, int u, int v) {
  if (std::abs(u) > lobe - 1 || std::abs(v) > 3 * lobe / 2) return 0;
  return std::abs(v) <= lobe / 2 ? -2 : 1;
}
int weightXy(int lobe, int u, int v) {
  if (u == 0 || v == 0 || std::abs(u) > lobe || std::abs(v) > lobe) return 0;
  return (u > 0) == (v > 0) ? 1 : -1;
}

struct Slow {
  double determinant, laplacian;
};
Slow slowHessian(const cv::Mat& image, BoxFilter filter, int x, int y) {
  double xx = 0, yy = 0, xy = 0;
  const int r = filter.radius();
  if (x < r || y < r || x + r >= image.cols || y + r >= image.rows) return {0, 0};
  for (int v = -r; v <= r; ++v)
    for (int u = -r; u <= r; ++u) {
      const double gray = image.at<std::uint8_t>(y + v, x + u);
      xx += weightYy(filter.lobe_px, v, u) * gray;
      yy += weightYy(filter.lobe_px, u, v) * gray;
      xy += weightXy(filter.lobe_px, u, v) * gray;
    }
  const double area = filter.size() * filter.size();
  return {(xx * yy - 0.81 * xy * xy) / area / area, xx + yy};
}

TEST(SurfHessian, HasThePapersFilterSizes) {
  const int sizes[3][4] = {{9, 15, 21, 27}, {15, 27, 39, 51}, {27, 51, 75, 99}};
  for (int octave = 0; octave < 3; ++octave)
    for (int layer = 0; layer < 4; ++layer) EXPECT_EQ(filterOf(octave, layer).size(), sizes[octave][layer]);
  EXPECT_FLOAT_EQ(scaleOfSize(9), 1.2f);
}

TEST(SurfHessian, EqualsTheMasksSummedPixelByPixel) {
  for (const cv::Size size :
       {cv::Size(61, 47), cv::Size(27, 33), cv::Size(9, 9), cv::Size(8, 40), cv::Size(1, 1)}) {
    const cv::Mat image = noise(size.width, size.height);
    const IntegralImage integral = integralOf(image);
    BoxHessian hessian(integral);
    for (int octave = 0; octave < 2; ++octave)
      for (int layer = 0; layer < 4; ++layer) {
        const BoxFilter filter = filterOf(octave, layer);
        const int step = 1 << octave, columns = (size.width - 1) / step + 1;
        std::vector<float> fast(columns);
        for (int y = 0; y < size.height; ++y) {
          hessian.determinants(filter, y, step, fast.data());
          for (int k = 0; k < columns; ++k) {
            const double slow = slowHessian(image, filter, k * step, y).determinant;
            ASSERT_NEAR(fast[k], slow, 1e-4 * std::abs(slow) + 1e-3)
                << size << " filter " << filter.size() << " at " << k * step << ", " << y;
          }
        }
      }
  }
}

TEST(SurfHessian, KnowsDarkFromBright) {
  const cv::Mat image = noise(40, 40);
  const IntegralImage integral = integralOf(image);
  BoxHessian hessian(integral);
  for (int y = 13; y < 27; ++y)
    for (int x = 13; x < 27; ++x)
      EXPECT_EQ(hessian.isDark({9}, x, y), slowHessian(image, {9}, x, y).laplacian > 0) << x << ", " << y;
}

// Every pixel counts by the area of its share: on an image enlarged 16 times, those are whole pixels.
TEST(SurfHaar, EqualsTheSumOverSharesOfPixels) {
  const cv::Mat image = noise(23, 19);
  cv::Mat large;
  cv::resize(image, large, {}, kFixedOne, kFixedOne, cv::INTER_NEAREST);
  const IntegralImage integral = integralOf(image);
  const auto sum = [&](int x0, int y0, int x1, int y1) {
    return static_cast<float>(cv::sum(large(cv::Rect(cv::Point(x0, y0), cv::Point(x1, y1))))[0]);
  };
  cv::RNG random(3);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const int x = random.uniform(-20, 23 * 16 + 20), y = random.uniform(-20, 19 * 16 + 20);
    const int half = random.uniform(5, 90), cx = x + 8, cy = y + 8;  // the centre of pixel 0 is at 8 of 16
    const auto [dx, dy] = haarResponse(integral, x, y, half);
    const cv::Rect box(cx - half, cy - half, 2 * half, 2 * half);
    if ((box & cv::Rect(0, 0, large.cols, large.rows)) != box) {
      EXPECT_EQ(dx, 0);
      EXPECT_EQ(dy, 0);
      continue;
    }
    ++inside;
    EXPECT_FLOAT_EQ(dx, sum(cx, cy - half, cx + half, cy + half) - sum(cx - half, cy - half, cx, cy + half));
    EXPECT_FLOAT_EQ(dy, sum(cx - half, cy, cx + half, cy + half) - sum(cx - half, cy - half, cx + half, cy));
  }
  EXPECT_GT(inside, 500);
}

TEST(SurfHaar, IsExactWhereTheSumsOfTheImageOverflow) {
  const cv::Mat white(4200, 4200, CV_8U, cv::Scalar(255));  // 4.5e9 in all
  const IntegralImage integral = integralOf(white);
  const auto [dx, dy] = haarResponse(integral, toFixed(4100.3f), toFixed(4100.7f), toFixed(64));
  EXPECT_EQ(dx, 0);
  EXPECT_EQ(dy, 0);
}

TEST(SurfOrientation, IsThatOfARamp) {
  for (int degrees = -170; degrees <= 180; degrees += 25) {
    const double angle = degrees * std::numbers::pi / 180;
    cv::Mat ramp(81, 81, CV_8U);
    for (int y = 0; y < 81; ++y)
      for (int x = 0; x < 81; ++x)
        ramp.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
            128 + 2 * ((x - 40) * std::cos(angle) + (y - 40) * std::sin(angle)));
    const double found = dominantOrientation(integralOf(ramp), 40.3f, 39.6f, 2.1f) - angle;
    EXPECT_LT(std::abs(std::remainder(found, 2 * std::numbers::pi)), 0.02) << degrees;
  }
}

TEST(SurfDescriptor, HasLengthOneOrIsZero) {
  const IntegralImage textured = integralOf(texture(120, 120)),
                      flat = integralOf(cv::Mat(120, 120, CV_8U, 77));
  for (const bool extended : {false, true}) {
    std::vector<float> values(descriptorLength(extended));
    describe(textured, {60.2f, 58.8f, 2.3f, 0.7f}, extended, values.data());
    EXPECT_NEAR(cv::norm(values), 1, 1e-6);
    describe(flat, {60.2f, 58.8f, 2.3f, 0.7f}, extended, values.data());
    EXPECT_EQ(cv::norm(values), 0);
  }
}

// Of the 128 values, the two halves of each sum add up to one of the 64.
TEST(SurfDescriptor, ExtendedSplitsTheSums) {
  const IntegralImage image = integralOf(texture(120, 120));
  std::vector<float> plain(64), extended(128), joined(64);
  describe(image, {60, 60, 2.5f, -1}, false, plain.data());
  describe(image, {60, 60, 2.5f, -1}, true, extended.data());
  for (int cell = 0; cell < 16; ++cell)
    for (int k = 0; k < 4; ++k) {
      const float* of = extended.data() + 8 * cell + (k < 2 ? 0 : 4);
      joined[4 * cell + k] = of[k % 2] + of[k % 2 + 2];
    }
  const double length = cv::norm(joined);
  EXPECT_GT(std::abs(length - 1), 1e-3);  // something was split
  for (int i = 0; i < 64; ++i) EXPECT_NEAR(joined[i] / length, plain[i], 1e-5) << i;
}

// A ramp along x: in every cell dx is all there is, and the middle cells weigh most.
TEST(SurfDescriptor, OfARampIsItsGradient) {
  cv::Mat ramp(101, 101, CV_8U);
  for (int x = 0; x < 101; ++x) ramp.col(x) = 2 * x;
  std::vector<float> values(64);
  describe(integralOf(ramp), {50, 50, 2, 0}, false, values.data());
  for (int cell = 0; cell < 16; ++cell) {
    const float* v = values.data() + 4 * cell;
    EXPECT_GT(v[0], 0);
    EXPECT_NEAR(v[0], v[1], 1e-6);
    EXPECT_NEAR(v[2], 0, 1e-6);
    EXPECT_NEAR(v[3], 0, 1e-6);
  }
  EXPECT_GT(values[4 * 5], 1.5f * values[4 * 4]);
  EXPECT_GT(values[4 * 4], values[0]);
}

}  // namespace
}  // namespace pomona
