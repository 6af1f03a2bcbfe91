// sobel-sift: its masks, its fused picture, and how well it ranges targets.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "bench/sparse/pairs.h"
#include "bench/sparse/targets.h"
#include "plugins/sobel_sift/four_direction_sobel.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

LoadedPlugin load() {
  return LoadedPlugin(POMONA_BUILT_PLUGINS "/sobel-sift.so");
}

SparseResult run(LoadedPlugin& plugin, const TargetPair& pair,
                 const std::vector<std::string>& assignments = {}, bool masked = true) {
  PluginSettings settings = plugin.settings();
  settings.assign(assignments);
  PluginRunOptions inputs;
  if (masked) inputs.mask = pair.mask;
  return plugin.run(pair.left, pair.right, pair.calibration, settings, inputs);
}

// A ramp of slope 1 that rises towards `degrees`, y up.
cv::Mat ramp(double degrees) {
  cv::Mat image(15, 15, CV_32F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<float>(y, x) =
          static_cast<float>(x * std::cos(degrees * CV_PI / 180) - y * std::sin(degrees * CV_PI / 180));
  return image;
}

TEST(FourDirectionSobel, EveryMaskIsAGradientOfItsDirection) {
  for (int direction = 0; direction < 4; ++direction) {
    const cv::Mat mask = sobelMask(direction);
    EXPECT_EQ(cv::sum(mask)[0], 0) << "even areas give 0: " << 45 * direction;
    const auto response = [&](double degrees) { return mask.dot(ramp(degrees)(cv::Rect(6, 6, 3, 3))); };
    const double along = response(45 * direction);
    EXPECT_GT(along, 7) << 45 * direction;
    EXPECT_NEAR(response(45 * direction + 90), 0, 1e-4) << 45 * direction;
    for (int other = 0; other < 360; other += 15) EXPECT_LE(response(other), along + 1e-4);
  }
  EXPECT_THROW(sobelMask(4), std::invalid_argument);
}

TEST(FourDirectionSobel, StrengthIsThatOfTheBestDirection) {
  cv::Mat step(20, 20, CV_8U, cv::Scalar(0));
  step.colRange(10, 20).setTo(255);
  cv::Mat edges = edgeStrength(step);
  EXPECT_EQ(edges.at<std::uint8_t>(8, 10), 255);
  EXPECT_EQ(edges.at<std::uint8_t>(8, 9), 255);
  EXPECT_EQ(edges.at<std::uint8_t>(8, 3), 0);
  EXPECT_EQ(edges.at<std::uint8_t>(0, 19), 0) << "the border is no edge";
  cv::Mat flipped;
  cv::transpose(edges, flipped);
  EXPECT_EQ(cv::norm(edgeStrength(step.t()), flipped, cv::NORM_INF), 0);
}

TEST(FourDirectionSobel, FusionWeighsGrayAndEdges) {
  cv::Mat step(20, 20, CV_8U, cv::Scalar(40));
  step.colRange(10, 20).setTo(200);
  EXPECT_EQ(cv::norm(fusedWithEdges(step, 0), step, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(fusedWithEdges(step, 1), edgeStrength(step), cv::NORM_INF), 0);
  EXPECT_EQ(fusedWithEdges(step, 0.5).at<std::uint8_t>(5, 3), 20);
  EXPECT_EQ(fusedWithEdges(step, 0.5).at<std::uint8_t>(5, 10), 180) << "(200 + 4 * 160 / 4) / 2";
}

TEST(SobelSift, RangesTargetsBetterThanPublishedInEveryBin) {
  LoadedPlugin plugin = load();
  for (const DistanceBin& bin : distanceBins())
    for (const TargetPair& pair : targetPairs(bin, 1)) {
      const SparseResult result = run(plugin, pair);
      ASSERT_EQ(result.objects.size(), 1u);
      const SparseObject& target = result.objects[0];
      ASSERT_TRUE(target.found()) << target.why_not;
      EXPECT_EQ(target.support, static_cast<int>(result.points.size()));
      double sum = 0;
      for (const SparsePoint& p : result.points) {
        const double true_m = truthAt(pair.depth_m, p.left_px);
        sum += 100 * std::abs(p.point_m.z - true_m) / true_m;
      }
      EXPECT_LT(sum / target.support, 0.5 * bin.published_percent) << bin.nearest_m;
      const double distance_m = cv::norm(target.point_m);
      EXPECT_NEAR(target.distance_m, distance_m, 1e-9);
      EXPECT_NEAR(target.bearing_deg, std::atan2(target.point_m.x, target.point_m.z) * 180 / CV_PI, 1e-9);
      EXPECT_GT(target.sigma_m, 0);
      EXPECT_LT(target.sigma_m, 0.05 * distance_m);
    }
}

TEST(SobelSift, TheSensorsMeasuresGiveTheSameRangesAsTheirCalibration) {
  LoadedPlugin plugin = load();
  const TargetPair pair = targetPairs({1, 2, 0}, 1)[0];
  const SparseResult by_calibration = run(plugin, pair);
  const SparseResult by_sensor = run(plugin, pair, {"physical_sensor=on"});
  const SparseResult wider = run(plugin, pair, {"physical_sensor=on", "baseline_mm=120"});
  const double z_m = by_calibration.objects[0].point_m.z;
  EXPECT_NEAR(by_sensor.objects[0].point_m.z, z_m, 1e-6 * z_m);
  EXPECT_NEAR(wider.objects[0].point_m.z, 2 * z_m, 1e-5 * z_m);
}

TEST(SobelSift, FaithfulPointsPassTheCulls) {
  LoadedPlugin plugin = load();
  const TargetPair pair = targetPairs({0.5, 1, 0}, 1)[0];
  const SparseResult result = run(plugin, pair, {"variant=faithful"}, false);
  ASSERT_GT(result.points.size(), 3u);
  EXPECT_TRUE(result.objects.empty()) << "without a mask there is no target";
  for (const SparsePoint& p : result.points) {
    EXPECT_GT(p.left_px.x, p.right_px.x);
    EXPECT_LE(std::abs(p.left_px.y - p.right_px.y), 10);
  }
}

TEST(SobelSift, ATargetWithoutTextureIsNotFound) {
  LoadedPlugin plugin = load();
  TargetPair pair = targetPairs({1, 2, 0}, 1)[0];
  pair.left.setTo(cv::Scalar::all(90));
  for (const char* variant : {"variant=default", "variant=faithful"}) {
    const SparseResult result = run(plugin, pair, {variant});
    ASSERT_EQ(result.objects.size(), 1u);
    EXPECT_FALSE(result.objects[0].found());
    EXPECT_EQ(result.objects[0].why_not, "no match inside of the mask");
    EXPECT_TRUE(std::isnan(result.objects[0].distance_m));
  }
}

}  // namespace
}  // namespace pomona
