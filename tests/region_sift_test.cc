// region-sift: its regions, its points on a room whose floor has little texture, its map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "bench/sparse/pairs.h"
#include "bench/sparse/plain_sift.h"
#include "datasets/rendering/indoor.h"
#include "plugins/common/refine_disparity.h"
#include "plugins/region_sift/map_pictures.h"
#include "plugins/region_sift/regions.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

LoadedPlugin load() {
  return LoadedPlugin(POMONA_BUILT_PLUGINS "/region-sift.so");
}

const RenderedPair& room() {
  static const RenderedPair pair = [] {
    SceneDescription cameras;
    cameras.width = 480;
    cameras.height = 360;
    cameras.focal_px = 480;
    cameras.baseline_m = 0.12;
    CameraEffects effects;
    effects.blur_px = 0.5;
    effects.shot_noise = effects.read_noise = 1;
    IndoorOptions options;
    options.contrast = 20;
    return render(indoor(cameras, options).scene, effects);
  }();
  return pair;
}

SparseResult run(LoadedPlugin& plugin, const std::vector<std::string>& assignments = {},
                 const PluginRunOptions& inputs = {}) {
  PluginSettings settings = plugin.settings();
  settings.assign(assignments);
  return plugin.run(room().left.image, room().right.image, room().calibration, settings, inputs);
}

int areaOf(const std::vector<cv::Rect>& regions) {
  int area = 0;
  for (const cv::Rect& r : regions) area += r.area();
  return area;
}

TEST(Regions, ColumnsAndNearStripLieBelowTheFarStrip) {
  const std::vector<cv::Rect> regions = regionsOf({300, 90}, {});
  ASSERT_EQ(regions.size(), 4u);
  EXPECT_EQ(regions[0], cv::Rect(0, 30, 100, 60));
  EXPECT_EQ(regions[1], cv::Rect(100, 30, 100, 60));
  EXPECT_EQ(regions[2], cv::Rect(200, 30, 100, 60));
  EXPECT_EQ(regions[3], cv::Rect(0, 60, 300, 30));
}

TEST(Regions, FarAndWholeAreAddedOnDemandAndJoinedToOne) {
  RegionOptions options;
  options.far_region = options.whole_region = true;
  const std::vector<cv::Rect> all = regionsOf({301, 91}, options);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[4].tl(), cv::Point(0, 0));
  EXPECT_EQ(all[5], cv::Rect(0, 0, 301, 91));
  EXPECT_EQ(areaOf({all[0], all[1], all[2], all[4]}), 301 * 91) << "columns and far strip tile the view";
  options.whole_region = options.far_region = false;
  options.joined = true;
  EXPECT_EQ(regionsOf({301, 91}, options), std::vector<cv::Rect>{cv::Rect(0, 30, 301, 61)});
}

TEST(Regions, FeaturesAreReportedInTheViewAndEachOnce) {
  RegionOptions options;
  options.equalise = false;
  options.sift.contrast_threshold = 0.01;
  const ViewFeatures split = regionFeatures(room().left.image, {}, options);
  ASSERT_GT(split.keypoints.size(), 100u);
  ASSERT_EQ(static_cast<int>(split.keypoints.size()), split.descriptors.rows);
  const float far_px = static_cast<float>(regionsOf(room().left.image.size(), options)[0].y);
  for (const cv::KeyPoint& k : split.keypoints) EXPECT_GE(k.pt.y, far_px - 1);
  for (std::size_t i = 0; i < split.keypoints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const cv::KeyPoint &a = split.keypoints[i], &b = split.keypoints[j];
      const bool same = cv::norm(a.pt - b.pt) < 0.3 && std::abs(a.size - b.size) < 0.05 * a.size &&
                        std::abs(a.angle - b.angle) < 5;
      EXPECT_FALSE(same) << a.pt << " twice";
    }
  // The near strip overlaps the columns; what only it finds lies near the seams between these.
  options.joined = true;
  const ViewFeatures joined = regionFeatures(room().left.image, {}, options);
  EXPECT_NEAR(static_cast<double>(split.keypoints.size()), static_cast<double>(joined.keypoints.size()),
              0.25 * static_cast<double>(joined.keypoints.size()));
}

TEST(Regions, KeypointsOfAScaledPictureLieWhereTheyAreInTheView) {
  cv::Mat dot(240, 320, CV_8U, cv::Scalar(60));
  for (int y = 0; y < dot.rows; ++y)
    for (int x = 0; x < dot.cols; ++x)
      dot.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
          60 + 160 * std::exp(-((x - 201) * (x - 201) + (y - 163) * (y - 163)) / (2 * 5.0 * 5.0)));
  for (const double scale : {1.0, 0.6, 0.5}) {
    RegionOptions options;
    options.equalise = false;
    options.joined = true;
    options.scale = scale;
    const ViewFeatures features = regionFeatures(dot, {}, options);
    ASSERT_FALSE(features.keypoints.empty()) << scale;
    const auto strongest = std::max_element(features.keypoints.begin(), features.keypoints.end(),
                                            [](auto& a, auto& b) { return a.response < b.response; });
    EXPECT_NEAR(strongest->pt.x, 201, 0.12) << scale;
    EXPECT_NEAR(strongest->pt.y, 163, 0.12) << scale;
  }
}

TEST(RefineDisparity, FindsTheFractionAndRefusesWhatDoesNotFit) {
  cv::Mat left(60, 200, CV_32F), noise(60, 200, CV_32F);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(noise, left, {}, 2);
  cv::normalize(left, left, 20, 235, cv::NORM_MINMAX);
  const float shift_px = 17.4f;
  cv::Mat right, left8, right8;
  cv::warpAffine(left, right, cv::Matx23d(1, 0, -shift_px, 0, 1, 0), left.size(), cv::INTER_CUBIC);
  left.convertTo(left8, CV_8U);
  right.convertTo(right8, CV_8U);
  const RefinedDisparity found = refineDisparity(left8, right8, {110.3f, 30.2f}, 17.9f);
  ASSERT_TRUE(found.ok);
  EXPECT_NEAR(found.disparity_px, shift_px, 0.05);
  EXPECT_GT(found.correlation, 0.99);
  EXPECT_GT(found.sigma_px, 0);
  EXPECT_LT(found.sigma_px, 0.1);
  EXPECT_FALSE(refineDisparity(left8, right8, {110, 30}, 40).ok) << "another place";
  EXPECT_FALSE(refineDisparity(left8, right8, {3, 30}, 0).ok) << "the window leaves the view";
  EXPECT_FALSE(refineDisparity(left8, right8, {20, 30}, 18).ok) << "the other window leaves the view";
  const cv::Mat even(60, 200, CV_8U, cv::Scalar(90));
  EXPECT_FALSE(refineDisparity(even, even, {110, 30}, 17).ok) << "nothing to go by";
}

TEST(RegionSift, FindsManyTimesThePointsOfPlainSiftAndNearlyAllAreRight) {
  LoadedPlugin plugin = load();
  const SparseResult result = run(plugin);
  const auto plain = runPlainSift(room().left.image, room().right.image, room().calibration);
  EXPECT_GE(result.points.size(), 5 * plain.points.size());
  const PointAccuracy accuracy = accuracyOf(result.points, room().left.disparity);
  EXPECT_GE(accuracy.known, 150);
  EXPECT_GE(accuracy.percentRight(), 95);
  EXPECT_LT(accuracy.medianPx(), 0.2);
}

TEST(RegionSift, PointsSatisfyTheConstraintsAndHaveTheirDepth) {
  LoadedPlugin plugin = load();
  const StereoCalibration& c = room().calibration;
  for (const char* variant : {"variant=default", "variant=faithful"}) {
    const SparseResult result = run(plugin, {variant, "far_share=0.5"});
    ASSERT_GT(result.points.size(), 50u) << variant;
    for (const SparsePoint& p : result.points) {
      EXPECT_GE(p.disparity_px, 2) << "3, before registration";
      EXPECT_LE(std::abs(p.left_px.y - p.right_px.y), 3);
      EXPECT_GE(p.left_px.y, 0.5f * static_cast<float>(c.height) - 2) << "the far strip is left out";
      // That a left half never meets a right half follows from x_left > x_right.
      const float middle = static_cast<float>(c.width) / 2;
      EXPECT_FALSE(p.left_px.x < middle && p.right_px.x >= middle);
      const double dx_left = p.left_px.x - c.cx_px, dx_right = c.cx_px - p.right_px.x;
      EXPECT_NEAR(p.point_m.z, c.focal_px * c.baseline_m / (dx_left + dx_right), 1e-3 * p.point_m.z);
      EXPECT_NEAR(p.point_m.y, (p.left_px.y - c.cy_px) * p.point_m.z / c.focal_px, 1e-3);
    }
  }
}

TEST(RegionSift, TheFloorLiesAtHeightZero) {
  LoadedPlugin plugin = load();
  const SparseResult result = run(plugin);
  int floor = 0, on_it = 0;
  for (const SparsePoint& p : result.points) {
    if (p.point_m.z > 1.7) continue;  // nearer than any box
    ++floor;
    on_it += std::abs(0.5 - p.point_m.y) < 0.02;
  }
  ASSERT_GT(floor, 30);
  EXPECT_GT(on_it, 0.95 * floor);
}

TEST(RegionSift, DrawsTheMapFromTheFrontAndFromAbove) {
  LoadedPlugin plugin = load();
  const SparseResult result = run(plugin);
  ASSERT_EQ(result.pictures.size(), 2u);
  EXPECT_EQ(result.pictures[0].name, "map-front");
  EXPECT_EQ(result.pictures[1].name, "map-top");
  for (const SparsePicture& picture : result.pictures) {
    cv::Mat hsv, colored;
    cv::cvtColor(picture.image, hsv, cv::COLOR_BGR2HSV);
    cv::inRange(hsv, cv::Scalar(0, 128, 64), cv::Scalar(180, 255, 255), colored);
    EXPECT_GT(cv::countNonZero(colored), 500) << picture.name;
  }
  EXPECT_TRUE(run(plugin, {"map=off"}).pictures.empty());
  EXPECT_TRUE(mapPictures({}, 0.5).empty());
}

TEST(RegionSift, HonoursTheMask) {
  LoadedPlugin plugin = load();
  PluginRunOptions inputs;
  inputs.mask = cv::Mat::zeros(room().left.image.size(), CV_8U);
  inputs.mask.colRange(200, 300).setTo(255);
  const SparseResult result = run(plugin, {}, inputs);
  ASSERT_FALSE(result.points.empty());
  for (const SparsePoint& p : result.points) {
    EXPECT_GE(p.left_px.x, 198);
    EXPECT_LE(p.left_px.x, 301);
  }
}

TEST(RegionSift, NothingToFindIsAResult) {
  LoadedPlugin plugin = load();
  StereoCalibration calibration = room().calibration;
  for (const cv::Size size : {cv::Size(480, 360), cv::Size(5, 4), cv::Size(1, 1)}) {
    const cv::Mat even(size, CV_8U, cv::Scalar(90));
    calibration.width = size.width;
    calibration.height = size.height;
    for (const char* variant : {"default", "faithful"}) {
      PluginSettings settings = plugin.settings();
      settings.set("variant", variant);
      EXPECT_TRUE(plugin.run(even, even, calibration, settings).points.empty()) << size << variant;
    }
  }
}

TEST(RegionSift, RealPairsGiveRightPoints) {
  const char* const folder = std::getenv("POMONA_DATASETS");
  if (!folder) GTEST_SKIP() << "POMONA_DATASETS names no folder of real pairs";
  constexpr std::size_t kMostPairs = 6;
  std::vector<TruthPair> pairs = realPairs(folder);
  pairs.resize(std::min(pairs.size(), kMostPairs));
  LoadedPlugin plugin = load();
  PluginSettings settings = plugin.settings();
  settings.assign(std::vector<std::string>{"far_region=on", "scale=1", "max_features=0"});
  PointAccuracy all;
  std::size_t plain = 0;
  for (const TruthPair& pair : pairs) {
    const SparseResult result = plugin.run(pair.left, pair.right, pair.calibration, settings);
    all.add(accuracyOf(result.points, pair.truth));
    plain += runPlainSift(pair.left, pair.right, pair.calibration).points.size();
  }
  EXPECT_GT(all.percentRight(), 90);
  EXPECT_GT(all.known, 1.2 * static_cast<double>(plain));
}

TEST(RegionSift, TheSamePointsForAnyNumberOfThreads) {
  LoadedPlugin plugin = load();
  PluginRunOptions one;
  one.threads = 1;
  const SparseResult a = run(plugin, {}, one), b = run(plugin);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].left_px, b.points[i].left_px);
    EXPECT_EQ(a.points[i].disparity_px, b.points[i].disparity_px);
  }
}

TEST(Indoor, ShowsWhatItsListSays) {
  SceneDescription cameras;
  cameras.width = 160;
  cameras.height = 120;
  cameras.focal_px = 160;
  cameras.baseline_m = 0.12;
  const Indoor scene = indoor(cameras);
  ASSERT_EQ(scene.obstacles.size(), 5u);
  const RenderedPair pair = render(scene.scene);
  int seen = 0;
  for (const Obstacle& o : scene.obstacles) {
    EXPECT_GE(o.near_point_m[2], 1.8);
    EXPECT_LE(o.near_point_m[2], 4);
    EXPECT_NEAR(o.near_point_m[1] + o.height_m / 2, 0.5, 1e-9) << "stands on the floor";
    seen += cv::countNonZero(pair.left.surface == o.first_surface) > 5;
  }
  EXPECT_GE(seen, 4);
  IndoorOptions wrong;
  wrong.contrast = 0;
  EXPECT_THROW(indoor(cameras, wrong), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
