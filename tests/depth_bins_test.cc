// Depth errors by distance: which pixels count, where, and with what error.
#include "bench/depth/depth_bins.h"

#include <gtest/gtest.h>

#include <limits>

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// f B = 100 px m, doffs 10 px: depth is 100 / (d + 10).
StereoCalibration calibration() {
  return {1000, 0, 0, 0.1, 10, 0, 0, 0};
}

cv::Mat row(std::initializer_list<float> values) {
  return cv::Mat1f(values).reshape(1, 1);
}

TEST(DepthBins, HoldThePixelsOfTheirTrueDepth) {
  StereoResult map;  // depths 1, 1.02, 2.5, none; none; none
  map.disparity = row({90, 100 / 1.02f - 10, 30, kNan, 5, 6});
  map.sigma_px = row({1, 1, 1, kNan, 1, 1});
  const cv::Mat truth = row({90, 90, 40, 40, kInfinity, -10});  // 1, 1, 2, 2, none, at infinity
  const std::vector<DepthBin> bins = depthBins(map, truth, calibration(), 0.8);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_NEAR(bins[0].nearest_m, 0.8, 1e-12);
  EXPECT_NEAR(bins[1].farthest_m, 2.4, 1e-12);
  ASSERT_EQ(bins[0].pixels.size(), 2u);
  EXPECT_NEAR(bins[0].pixels[0].sigma_m, 0.01, 1e-6);  // Z^2 / (f B)
  const DistanceErrors near = errorsOf(bins[0].pixels), far = errorsOf(bins[1].pixels);
  EXPECT_NEAR(near.p95_percent, 2, 1e-3);
  EXPECT_EQ(near.within_2_sigma_percent, 100);
  EXPECT_EQ(far.all, 2);
  EXPECT_EQ(far.measured, 1);
  EXPECT_NEAR(far.median_mm, 500, 0.01);
  EXPECT_EQ(far.within_2_sigma_percent, 0);

  const std::string table = depthTable({{"ours", bins}}, calibration());
  EXPECT_NE(table.find("| depth | pixels | 1 px is | ours: median | median | P95 | within 2 sigma |"),
            table.npos);
  EXPECT_NE(table.find("| 1.6 - 2.4 m | 2 | 2.00 % | 500.0 mm | 25.00 % | 25.00 % | 0 % |"), table.npos)
      << table;
}

TEST(DepthBins, RefuseWhatDoesNotFit) {
  StereoResult map;
  map.disparity = row({1, 2});
  EXPECT_THROW(depthBins(map, row({1, 2, 3}), calibration(), 1), std::invalid_argument);
  EXPECT_THROW(depthBins(map, row({1, 2}), calibration(), 0), std::invalid_argument);
  EXPECT_TRUE(std::isnan(depthBins(map, row({1, 2}), calibration(), 100)[0].pixels[0].sigma_m));
}

}  // namespace
}  // namespace pomona
