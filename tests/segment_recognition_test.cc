// Regions of disparity maps, and objects recognised by the features in them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "bench/sparse/object_scenes.h"
#include "bench/sparse/precision_recall.h"
#include "bench/sparse/real_queries.h"
#include "bench/sparse/temporary_folder.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "plugins/segment_recognition/recognition.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

StereoCalibration plainRig() {
  StereoCalibration rig;
  rig.focal_px = 100;
  rig.baseline_m = 0.3;  // disparity 10 at 3 m
  return rig;
}

TEST(NearRegions, AreLargeAndNear) {
  cv::Mat disparity(100, 160, CV_32F, cv::Scalar(5));
  disparity(cv::Rect(20, 20, 30, 30)).setTo(12);
  disparity(cv::Rect(50, 34, 40, 3)).setTo(12);    // narrower than the opening
  disparity(cv::Rect(100, 20, 10, 10)).setTo(12);  // too small
  disparity(cv::Rect(100, 60, 40, 30)).setTo(9.9f);
  disparity(cv::Rect(20, 60, 40, 30)).setTo(kNaN);
  RegionOptions options;
  options.margin_px = 0;
  const cv::Mat regions = nearRegions(disparity, plainRig(), options);
  cv::Mat expected = cv::Mat::zeros(disparity.size(), CV_8U);
  expected(cv::Rect(20, 20, 30, 30)).setTo(255);
  EXPECT_EQ(cv::norm(regions, expected, cv::NORM_L1), 0);
  options.margin_px = 2;
  EXPECT_EQ(cv::countNonZero(nearRegions(disparity, plainRig(), options)), 34 * 34);
  options.margin_px = 0;
  options.far_m = 4;
  EXPECT_EQ(cv::countNonZero(nearRegions(disparity, plainRig(), options)), 30 * 30 + 40 * 30);
}

TEST(NearRegions, MoveToTheRightView) {
  cv::Mat regions = cv::Mat::zeros(60, 100, CV_8U), disparity(60, 100, CV_32F, cv::Scalar(12));
  regions(cv::Rect(40, 10, 30, 30)).setTo(255);
  disparity.at<float>(20, 50) = kNaN;
  RegionOptions options;
  options.margin_px = 0;
  cv::Mat expected = cv::Mat::zeros(60, 100, CV_8U);
  expected(cv::Rect(28, 10, 30, 30)).setTo(255);
  EXPECT_EQ(cv::norm(regionsInRightView(regions, disparity, options), expected, cv::NORM_L1), 0);
}

// One of the benchmark's rooms, with its dense map.
struct Room {
  ObjectScene scene = objectScene(3);
  RectifiedPair pair{scene.pair.left.image, scene.pair.right.image};
  StereoResult map;
  std::function<const StereoResult&()> dense = [this]() -> const StereoResult& { return map; };

  Room() {
    Options options = Options::preset("balanced");
    options.num_disparities = scene.pair.calibration.num_disparities;
    map = computeDisparity(pair.left, pair.right, options);
  }
};
const Room& room() {
  static const Room made;
  return made;
}

ObjectDatabase covers(FeatureKind kind, int count = kKnownCovers) {
  ObjectDatabase database{kind, {}};
  for (int i = 0; i < count; ++i)
    database.objects.push_back(learnObject("cover " + std::to_string(i), coverPicture(i), {kind, 1, {}}));
  return database;
}

TEST(BlockMatching, ReachesTheLeftBorder) {
  const RenderedPair& pair = room().scene.pair;
  const cv::Mat map = blockMatchingDisparity(grayOf(pair.left.image), grayOf(pair.right.image), 48);
  ASSERT_EQ(map.size(), pair.left.image.size());
  int known = 0, right = 0, at_left = 0;
  for (int y = 10; y < map.rows - 10; ++y)
    for (int x = 20; x < map.cols - 10; ++x) {
      const float d = map.at<float>(y, x);
      if (!std::isfinite(d)) continue;
      ++known;
      right += std::abs(d - pair.left.disparity.at<float>(y, x)) <= 1;
      at_left += x < 48;
    }
  EXPECT_GT(known, map.total() / 2);
  EXPECT_GT(right, 0.85 * known);
  EXPECT_GT(at_left, 1000);
}

ComparedFeatures compared(const ObjectMatcher& matcher, FeatureFilter filter, FeatureDisparity disparity) {
  RecognitionOptions options;
  options.filter = filter;
  options.disparity = disparity;
  return compareFeatures(room().pair, room().scene.pair.calibration, {}, room().dense, matcher, options);
}

TEST(CompareFeatures, EachFilterLeavesFewer) {
  const ObjectDatabase database = covers(FeatureKind::kSift);
  const ObjectMatcher matcher(database);
  const auto by_partner = [&](FeatureFilter filter) {
    return compared(matcher, filter, FeatureDisparity::kPartner);
  };
  const ComparedFeatures all = by_partner(FeatureFilter::kNone),
                         epipolar = by_partner(FeatureFilter::kEpipolar),
                         near = by_partner(FeatureFilter::kDisparity);
  EXPECT_LT(epipolar.features.count(), all.features.count());
  EXPECT_LT(2 * near.features.count(), epipolar.features.count());
  EXPECT_GT(near.features.count(), 100);
  const auto off_row = [](const SparsePoint& p) { return std::abs(p.left_px.y - p.right_px.y) > 1; };
  EXPECT_TRUE(std::any_of(all.points.begin(), all.points.end(), off_row));
  EXPECT_TRUE(std::none_of(epipolar.points.begin(), epipolar.points.end(), off_row));
  for (const SparsePoint& point : epipolar.points) EXPECT_GT(point.disparity_px, 0);
  int far = 0;
  for (const SparsePoint& point : near.points) far += point.point_m.z > 3;
  EXPECT_LT(far, near.features.count() / 10);
}

TEST(CompareFeatures, TakesDisparitiesFromTheMap) {
  const ObjectDatabase database = covers(FeatureKind::kSift);
  const ObjectMatcher matcher(database);
  const ComparedFeatures features = compared(matcher, FeatureFilter::kDisparity, FeatureDisparity::kMap);
  ASSERT_GT(features.features.count(), 300);
  for (int i = 0; i < features.features.count(); ++i) {
    const cv::Point2f at = features.features.keypoints[i].pt;
    EXPECT_EQ(features.points[i].disparity_px, at.x - features.points[i].right_px.x);
    EXPECT_NEAR(features.points[i].disparity_px, room().map.disparity.at<float>(cvRound(at.y), cvRound(at.x)),
                1e-3);
  }
}

TEST(ObjectMatcher, DoesNotLetViewsOfOnePlaceCompete) {
  const ObjectDatabase wide{FeatureKind::kSift,
                            {learnObject("cover", coverPicture(1), {FeatureKind::kSift, 1, {-10, 10}})}};
  const ObjectDatabase frontal{FeatureKind::kSift,
                               {learnObject("cover", coverPicture(1), {FeatureKind::kSift, 1, {}})}};
  const Features seen = FeatureFinder(FeatureKind::kSift).find(room().pair.left);
  const auto unmistakable = [&](const ObjectDatabase& database) {
    int count = 0;
    for (const ObjectMatch& match : ObjectMatcher(database).match(seen.descriptors))
      count += match.ratio < 0.7f;
    return count;
  };
  EXPECT_GT(unmistakable(frontal), 20);
  EXPECT_GT(unmistakable(wide), 0.8 * unmistakable(frontal));
}

TEST(RecogniseObjects, FindsAndRangesThem) {
  const ObjectDatabase database = covers(FeatureKind::kRootSift, kKnownCovers + 1);
  const SparseResult result =
      recogniseObjects(room().pair, room().scene.pair.calibration, {}, room().dense, database, {});
  ASSERT_EQ(result.objects.size(), 4u);
  for (const PlacedObject& placed : room().scene.objects) {
    const SparseObject& object = result.objects[placed.cover];
    ASSERT_TRUE(object.found()) << object.label << ": " << object.why_not;
    EXPECT_NEAR(object.distance_m, placed.distance_m, 0.01 * placed.distance_m) << object.label;
  }
  // The fourth may hang as a poster at the wall: too far to be looked at.
  EXPECT_FALSE(result.objects[3].found());
}

TEST(RecogniseObjects, RespectsTheMask) {
  const ObjectDatabase database = covers(FeatureKind::kRootSift);
  const PlacedObject& hidden = room().scene.objects[1];
  cv::Mat mask(room().pair.left.size(), CV_8U, cv::Scalar(255));
  mask.setTo(0, room().scene.pair.left.surface == hidden.surface);
  const SparseResult result =
      recogniseObjects(room().pair, room().scene.pair.calibration, mask, room().dense, database, {});
  for (const PlacedObject& placed : room().scene.objects)
    EXPECT_EQ(result.objects[placed.cover].found(), placed.surface != hidden.surface) << placed.cover;
}

TEST(PrecisionRecall, CountsUpToEachLimit) {
  const JudgedMatches judged{"", {{0.2f, true}, {0.4f, true}, {0.5f, false}, {0.9f, true}}, 10};
  const std::vector<PrecisionRecall> curve = curveOf(judged);
  EXPECT_DOUBLE_EQ(recallAt(curve, 0), 0.2);
  EXPECT_DOUBLE_EQ(recallAt(curve, 0.26), 0.3);
  EXPECT_DOUBLE_EQ(curve.back().false_share, 0.25);
}

class SegmentRecognitionPlugin : public ::testing::Test {
 protected:
  LoadedPlugin plugin_{POMONA_SEGMENT_RECOGNITION};
  TemporaryFolder folder_;
};

TEST_F(SegmentRecognitionPlugin, RunsInBothVariants) {
  std::string paths;
  for (int i = 0; i < kKnownCovers; ++i) {
    const std::string path = folder_.file("cover" + std::to_string(i) + ".png");
    writeFile(path, encodeImage(coverPicture(i)));
    paths += (i ? "," : "") + path;
  }
  for (const char* variant : {"default", "faithful"}) {
    PluginSettings settings = plugin_.settings();
    settings.set("variant", variant);
    settings.set("objects", paths);
    const SparseResult result =
        plugin_.run(room().pair.left, room().pair.right, room().scene.pair.calibration, settings);
    ASSERT_EQ(result.objects.size(), 3u);
    for (const PlacedObject& placed : room().scene.objects) {
      const SparseObject& object = result.objects[placed.cover];
      ASSERT_TRUE(object.found()) << variant << ", " << object.label << ": " << object.why_not;
      EXPECT_NEAR(object.distance_m, placed.distance_m, 0.03 * placed.distance_m) << variant;
    }
  }
}

TEST_F(SegmentRecognitionPlugin, NothingNearIsAResult) {
  const std::string path = folder_.file("cover.png");
  writeFile(path, encodeImage(coverPicture(0)));
  PluginSettings settings = plugin_.settings();
  settings.assign(std::vector<std::string>{"objects=" + path, "far_m=0.2"});
  const SparseResult result =
      plugin_.run(room().pair.left, room().pair.right, room().scene.pair.calibration, settings);
  EXPECT_EQ(result.objects.at(0).why_not, "0 of at least 4 features match");
  EXPECT_TRUE(result.points.empty());
}

TEST_F(SegmentRecognitionPlugin, FindsAlteredPicturesInRealPairs) {
  const char* const scenes = std::getenv("POMONA_DATASETS");
  if (!scenes) GTEST_SKIP() << "set POMONA_DATASETS to a folder with middlebury/<scene>/";
  for (const RealQuery& query : realQueries()) {
    const RealPair real = realPair(query, scenes);
    const std::string picture = folder_.file(query.scene + ".png");
    writeFile(picture, encodeImage(pictureOf(query, real.left)));
    PluginSettings settings = plugin_.settings();
    settings.assign(std::vector<std::string>{"objects=" + picture, "far_m=1000"});
    const SparseResult result = plugin_.run(real.left, real.right, real.calibration, settings);
    const SparseObject& object = result.objects.at(0);
    ASSERT_TRUE(object.found()) << query.scene << " " << query.label << ": " << object.why_not;
    EXPECT_NEAR(disparityOf(real.calibration, object.point_m.z), real.truth_px, 0.02 * real.truth_px)
        << query.scene << " " << query.label;
  }
}

}  // namespace
}  // namespace pomona
