// Signs that are found and ranged, and what a detector boxes.
#include "plugins/logo_range/logo_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "bench/sparse/object_scenes.h"
#include "bench/sparse/real_queries.h"
#include "bench/sparse/temporary_folder.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "plugins/common/disparity_plane.h"
#include "plugins/common/likeness.h"
#include "plugins/common/object_place.h"
#include "plugins/common/object_range.h"
#include "plugins/common/triangulation.h"
#include "plugins/logo_range/box_range.h"
#include "pomona/plugin_host.h"
#include "tests/tiny_networks.h"

namespace pomona {
namespace {

template <typename Work>
std::string errorOf(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

// A sign of 1.2 m x 0.4 m before a wall of noise: 480 x 320, f 600 px, baseline 120 mm.
struct Street {
  RenderedPair pair;
  cv::Vec3d middle_m;
};
Street street(double z_m, double yaw_deg, const cv::Mat& picture, double x_m = 0.1, double right_gain = 1) {
  SceneDescription scene;
  scene.width = 480;
  scene.height = 320;
  scene.focal_px = 600;
  scene.baseline_m = 0.12;
  scene.num_disparities = 48;
  scene.seed = 5;
  Paint wall{{60, 70, 80}, {140, 150, 160}, 0.3, Pattern::kMottle};
  scene.surfaces.push_back({Shape::kPlane, {0, 0, z_m + 2}, {1, 0, 0}, {0, 1, 0}, 0, wall});
  Paint sign;
  sign.pattern = Pattern::kPicture;
  sign.picture = picture;
  const double yaw = yaw_deg * CV_PI / 180;
  const cv::Vec3d middle(x_m, -0.2, z_m);
  scene.surfaces.push_back({Shape::kParallelogram,
                            middle,
                            cv::Vec3d(std::cos(yaw), 0, std::sin(yaw)) * 0.6,
                            {0, 0.2, 0},
                            0,
                            sign});
  CameraEffects effects;
  effects.shot_noise = 2;
  effects.right_gain = right_gain;
  return {render(scene, effects), middle};
}

ObjectDatabase databaseOf(const cv::Mat& picture, const std::vector<double>& yaws_deg) {
  const TrainingOptions options{FeatureKind::kRootSift, 2, yaws_deg};
  return {options.kind, {learnObject("sign", picture, options)}};
}

SparseObject lookFor(const ObjectDatabase& database, const Street& s, const LogoRangeOptions& options = {},
                     const cv::Mat& mask = {}) {
  const RectifiedPair pair{s.pair.left.image, s.pair.right.image};
  const SparseResult result = rangeSigns(pair, s.pair.calibration, mask, database, options);
  EXPECT_EQ(result.objects.size(), 1u);
  return result.objects.at(0);
}

TEST(ObjectDatabase, ComesBackFromItsFile) {
  ObjectDatabase database = databaseOf(signPicture(), {-45, 45});
  database.objects.push_back(
      {"plain", {30, 20}, cv::Mat(20, 30, CV_8U, cv::Scalar(7)), {{}, cv::Mat(0, 128, CV_32F)}});
  const TemporaryFolder folder;
  writeFile(folder.file("signs.objects"), encodeObjectDatabase(database));
  const ObjectDatabase read = readObjectDatabase(folder.file("signs.objects"));
  ASSERT_EQ(read.objects.size(), 2u);
  EXPECT_EQ(read.kind, database.kind);
  EXPECT_EQ(read.objects[1].label, "plain");
  EXPECT_EQ(read.objects[1].features.count(), 0);
  EXPECT_EQ(read.objects[1].thumbnail.size(), cv::Size(30, 20));
  const KnownObject &before = database.objects[0], &after = read.objects[0];
  EXPECT_EQ(after.size_px, before.size_px);
  EXPECT_EQ(after.thumbnail.size(), cv::Size(96, 32));
  EXPECT_EQ(cv::norm(after.thumbnail, before.thumbnail, cv::NORM_INF), 0);
  ASSERT_EQ(after.features.count(), before.features.count());
  ASSERT_GT(after.features.count(), 100);
  EXPECT_EQ(cv::norm(after.features.descriptors, before.features.descriptors, cv::NORM_INF), 0);
  EXPECT_EQ(after.features.keypoints[7].pt, before.features.keypoints[7].pt);
  EXPECT_EQ(after.features.keypoints.back().class_id, 2);
}

TEST(ObjectDatabase, RefusesWhatIsNoDatabase) {
  const TemporaryFolder folder;
  const std::string path = folder.file("signs.objects");
  const auto reading = [&](const std::string& bytes) {
    writeFile(path, bytes);
    return errorOf([&] { readObjectDatabase(path); });
  };
  const std::string good = encodeObjectDatabase(databaseOf(signPicture(), {}));
  EXPECT_EQ(reading(good), "");
  EXPECT_NE(reading("").find("byte 0: the database is empty"), std::string::npos);
  EXPECT_NE(reading("P5 3 3 255 and more").find("no database"), std::string::npos);
  for (const std::size_t length : {9ul, 15ul, 19ul, 25ul, 40ul, 41ul, 60ul, good.size() / 2, good.size() - 1})
    EXPECT_NE(reading(good.substr(0, length)).find("the file is cut off"), std::string::npos)
        << length << ": " << reading(good.substr(0, length));
  EXPECT_NE(reading(good + "x").find("nothing is allowed after"), std::string::npos);
  std::string other = good;
  other[8] = 1;
  EXPECT_NE(reading(other).find("byte 8: the version is 1; allowed: 2 to 2"), std::string::npos);
  other = good.substr(0, 16) + std::string(4, '\0');
  EXPECT_NE(reading(other).find("the database is empty"), std::string::npos);
}

TEST(DisparityPlane, IsThatOfMostPoints) {
  std::vector<PlaceDisparity> points;
  for (int i = 0; i < 40; ++i) {
    const cv::Point2d at(37 * i % 101, 53 * i % 89);
    points.push_back({at, 12 + 0.03 * at.x - 0.01 * at.y + (i % 3 == 0 ? 5 + i : 0)});
  }
  const auto plane = fitDisparityPlane(points, {50, 40}, 0.5, 10);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->disparity_px, 12 + 1.5 - 0.4, 1e-9);
  EXPECT_NEAR(plane->slope_x, 0.03, 1e-9);
  EXPECT_NEAR(plane->at({0, 0}), 12, 1e-9);
  EXPECT_FALSE(fitDisparityPlane(points, {50, 40}, 0.5, 39));
  EXPECT_FALSE(fitDisparityPlane({{{0, 0}, 1}, {{1, 1}, 1}, {{2, 2}, 1}}, {0, 0}, 0.5, 3));  // on one line
}

TEST(DisparityPlane, AlignsViewsOfDifferentBrightness) {
  const Street s = street(3, 40, signPicture(), 0.1, 0.8);
  const StereoCalibration& rig = s.pair.calibration;
  const cv::Point2d middle(rig.cx_px + 600 * s.middle_m[0] / 3, rig.cy_px + 600 * s.middle_m[1] / 3);
  const std::vector<cv::Point2f> inside{{200, 100}, {320, 100}, {320, 138}, {200, 138}};
  const cv::Mat left = grayOf(s.pair.left.image), right = grayOf(s.pair.right.image);
  const auto plane = alignDisparityPlane(left, right, inside, {middle, 24 + 0.9, 0, 0, 0});
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->disparity_px, 24, 0.03);  // f B / Z
  EXPECT_LT(plane->slope_x, -0.02);            // farther to the right
  EXPECT_GT(plane->sigma_px, 0);
  EXPECT_LT(plane->sigma_px, 0.1);
  EXPECT_FALSE(alignDisparityPlane(left, right, inside, {middle, 5, 0, 0, 0}));
  const cv::Mat gray(left.size(), CV_8U, cv::Scalar(99));
  EXPECT_FALSE(alignDisparityPlane(gray, gray, inside, {middle, 24, 0, 0, 0}));
}

TEST(LogoRange, TellsDistanceAndDirection) {
  const ObjectDatabase database = databaseOf(signPicture(), wideYaws());
  for (const double yaw_deg : {-45., 0., 45.}) {
    const Street s = street(3.5, yaw_deg, signPicture(), 0.4);
    const SparseObject object = lookFor(database, s);
    ASSERT_TRUE(object.found()) << yaw_deg << ": " << object.why_not;
    EXPECT_NEAR(object.distance_m, cv::norm(s.middle_m), 0.01 * 3.5) << yaw_deg;
    EXPECT_NEAR(object.bearing_deg, std::atan2(0.4, 3.5) * 180 / CV_PI, 0.2) << yaw_deg;
    EXPECT_GT(object.sigma_m, 0);
    EXPECT_EQ(object.outline_px.size(), 4u);
  }
}

TEST(LogoRange, NeedsWideViewsForSteepSigns) {
  const Street steep = street(4, 62, signPicture());
  EXPECT_TRUE(lookFor(databaseOf(signPicture(), wideYaws()), steep).found());
  EXPECT_FALSE(lookFor(databaseOf(signPicture(), {}), steep).found());
}

TEST(LogoRange, NotFoundIsAResult) {
  const Street s = street(3, 0, signPicture());
  const SparseObject other = lookFor(databaseOf(coverPicture(5), wideYaws()), s);
  EXPECT_NE(other.why_not.find(" of at least "), std::string::npos) << other.why_not;
  EXPECT_TRUE(std::isnan(other.distance_m));
  const SparseObject plain =
      lookFor(databaseOf(cv::Mat(80, 80, CV_8UC3, cv::Scalar::all(90)), wideYaws()), s);
  EXPECT_EQ(plain.why_not, "its picture has no features to recognise it by");
}

// A sign of the same frame and emblem as signPicture(), with another name.
cv::Mat signNamed(const std::string& name) {
  cv::Mat picture = signPicture();
  picture(cv::Rect(222, 40, 470, 164)).setTo(cv::Scalar(205, 225, 235));
  cv::putText(picture, name, {300, 170}, cv::FONT_HERSHEY_DUPLEX, 5, {70, 40, 20}, 14, cv::LINE_AA);
  return picture;
}

TEST(LogoRange, SignsThatShareAnEmblemAreNotTheSame) {
  const Street s = street(3, 20, signNamed("KIWI"));
  const ObjectDatabase database = databaseOf(signPicture(), wideYaws());
  const SparseObject object = lookFor(database, s);
  EXPECT_FALSE(object.found()) << object.distance_m;
  EXPECT_NE(object.why_not.find("is not like it"), std::string::npos) << object.why_not;
  LogoRangeOptions trusting;
  trusting.locate.min_likeness = -1;
  EXPECT_TRUE(lookFor(database, s, trusting).found()) << "by the emblem alone";
  EXPECT_TRUE(lookFor(databaseOf(signNamed("KIWI"), wideYaws()), s).found());
}

// What of the database's only object is seen in the left view.
ObjectPlace placeOf(const ObjectDatabase& database, const Street& s, const LocateOptions& options = {}) {
  const cv::Mat gray = grayOf(s.pair.left.image);
  const Features features = FeatureFinder(database.kind, 2).find(gray);
  const std::vector<ObjectMatch> matches = ObjectMatcher(database).match(features.descriptors);
  return locateObject(database.objects.at(0), 0, {gray, features, matches}, options);
}

TEST(LogoRange, FewerMatchesDoWhereTheViewEqualsThePicture) {
  const Street s = street(3, 0, signPicture());
  ObjectDatabase database = databaseOf(signPicture(), {});
  const ObjectPlace place = placeOf(database, s);
  ASSERT_GT(place.agreeing.size(), 20u) << place.why_not;
  KnownObject& object = database.objects[0];
  const Features all = object.features;
  object.features = {{}, cv::Mat(0, all.descriptors.cols, CV_32F)};
  for (int i = 0; i < 5; ++i) {
    const int feature = place.agreeing[i * place.agreeing.size() / 5].feature;
    object.features.keypoints.push_back(all.keypoints[feature]);
    object.features.descriptors.push_back(all.descriptors.row(feature));
  }
  EXPECT_TRUE(placeOf(database, s).found()) << placeOf(database, s).why_not;
  LocateOptions more;
  more.min_agreeing = 8;
  EXPECT_NE(placeOf(database, s, more).why_not.find("of at least 8 matches"), std::string::npos);
  object.thumbnail = thumbnailOf(signNamed("KIWI"));  // still like enough for six
  EXPECT_NE(placeOf(database, s).why_not.find("of at least 6 matches"), std::string::npos);
}

// Noise whose right view is `shift_px` to the left, and an object that is most of it.
struct Wall {
  cv::Mat left = cv::Mat(160, 240, CV_8U), right;
  ObjectPlace place;

  explicit Wall(double shift_px) {
    cv::RNG random(3);
    random.fill(left, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(left, left, {}, 1.5);
    left = (left - 128) * 4 + 128;
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, -shift_px, 0, 1, 0);
    cv::warpAffine(left, right, shift, left.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    place.outline_px = {{60, 30}, {200, 30}, {200, 130}, {60, 130}};
    place.middle_px = {130, 80};
  }
  // Ranged by features with these places and disparities.
  double disparity(const std::vector<cv::Point3f>& features) const {
    StereoCalibration rig;
    rig.focal_px = 240;
    rig.baseline_m = 0.1;
    const FlatObject flat{[&](const ObjectPlace&) {
                            std::vector<SparsePoint> points;
                            for (const cv::Point3f& f : features)
                              points.push_back(triangulate(rig, {f.x, f.y}, {f.x - f.z, f.y}, 0.5f));
                            return points;
                          },
                          [](const DisparityPlane&) {
                            ObjectPlace none;
                            none.why_not = "not asked";
                            return none;
                          }};
    SparseObject object;
    rangeByPlane(left, right, rig, flat, place, object);
    return object.found() ? disparityOf(rig, object.point_m.z) : std::numeric_limits<double>::quiet_NaN();
  }
};

TEST(RangeByPlane, DoesNotBelieveThreePointsAlone) {
  const std::vector<cv::Point3f> wrong{{70, 40, 35}, {150, 60, 90}, {90, 120, 60}};
  EXPECT_TRUE(std::isnan(Wall(10).disparity(wrong)));
  std::vector<cv::Point3f> some = wrong;
  some.insert(some.end(), {{100, 90, 10}, {180, 50, 10.3f}});
  EXPECT_NEAR(Wall(10).disparity(some), 10, 0.05);
}

TEST(RangeByPlane, StaysWithMostPoints) {
  std::vector<cv::Point3f> most;
  for (int i = 0; i < 30; ++i)
    most.emplace_back(static_cast<float>(65 + 37 * i % 130), static_cast<float>(35 + 53 * i % 90), 10.f);
  EXPECT_NEAR(Wall(10.2).disparity(most), 10.2, 0.05);
  EXPECT_NEAR(Wall(11.8).disparity(most), 10, 0.05) << "something else moves the views";
}

// Letters that occur twice match each other as well as themselves.
TEST(LogoRange, FindsSmallSignsWithRepeatedLetters) {
  const Street s = street(9, 45, signNamed("ZOO"));  // 57 px wide
  const SparseObject object = lookFor(databaseOf(signNamed("ZOO"), wideYaws()), s);
  ASSERT_TRUE(object.found()) << object.why_not;
  EXPECT_NEAR(object.distance_m, cv::norm(s.middle_m), 0.02 * 9);
}

TEST(Likeness, IsThatOfPictureAndPlace) {
  const cv::Mat picture = grayOf(signPicture()), thumbnail = thumbnailOf(picture);
  ASSERT_EQ(thumbnail.size(), cv::Size(96, 32));
  const cv::Matx33d map(0.5, -0.1, 60, 0.1, 0.4, 30, 0.0004, 0, 1);
  cv::Mat view(200, 480, CV_8U, cv::Scalar(90));
  cv::warpPerspective(0.5 * picture + 40, view, cv::Mat(map), view.size(), cv::INTER_AREA,
                      cv::BORDER_TRANSPARENT);
  EXPECT_GT(likeness(thumbnail, picture.size(), view, map), 0.95);
  const cv::Matx33d aside = cv::Matx33d(1, 0, 25, 0, 1, 10, 0, 0, 1) * map;
  EXPECT_LT(likeness(thumbnail, picture.size(), view, aside), 0.5);
  const cv::Matx33d outside = cv::Matx33d(1, 0, 400, 0, 1, 0, 0, 0, 1) * map;
  EXPECT_EQ(likeness(thumbnail, picture.size(), view, outside), -1);
  EXPECT_EQ(likeness(thumbnail, picture.size(), cv::Mat(200, 480, CV_8U, cv::Scalar(90)), map), -1);
}

TEST(LogoRange, LooksOnlyWhereItMay) {
  const ObjectDatabase database = databaseOf(signPicture(), {});
  const Street s = street(3, 0, signPicture());  // in the upper half
  ASSERT_TRUE(lookFor(database, s).found());
  LogoRangeOptions upper;
  upper.upper_half = true;
  EXPECT_TRUE(lookFor(database, s, upper).found());
  cv::Mat lower = cv::Mat::zeros(320, 480, CV_8U);
  lower.rowRange(160, 320).setTo(255);
  EXPECT_FALSE(lookFor(database, s, {}, lower).found());
  EXPECT_FALSE(lookFor(database, s, upper, lower).found());
}

// Gray views of 256 x 256 with a red square of 16 x 16 at disparity 16, which fills a cell of the tiny
// networks.
RectifiedPair redSquare() {
  RectifiedPair pair;
  pair.left = cv::Mat(256, 256, CV_8UC3, cv::Scalar::all(128));
  pair.right = pair.left.clone();
  pair.left(cv::Rect(128, 96, 16, 16)).setTo(cv::Scalar(0, 0, 255));
  pair.right(cv::Rect(112, 96, 16, 16)).setTo(cv::Scalar(0, 0, 255));
  return pair;
}

struct TinyFiles {
  TemporaryFolder folder;
  DetectorOptions darknet, onnx;

  TinyFiles() {
    writeFile(folder.file("tiny.cfg"), tinyDarknetShape());
    writeFile(folder.file("tiny.weights"), tinyDarknetWeights());
    writeFile(folder.file("tiny.onnx"), tinyOnnx());
    writeFile(folder.file("names"), "red thing\n");
    darknet.network = folder.file("tiny.cfg");
    onnx.network = folder.file("tiny.onnx");
    darknet.input_size_px = onnx.input_size_px = kTinyInput;
    darknet.labels = onnx.labels = folder.file("names");
  }
};

TEST(Detector, ReadsDarknetAndOnnx) {
  const TinyFiles files;
  for (const DetectorOptions& options : {files.darknet, files.onnx}) {
    Detector detector(options);
    const std::vector<Detection> seen = detector.detect(redSquare().left);
    ASSERT_EQ(seen.size(), 1u) << options.network;
    EXPECT_NEAR(seen[0].box_px.x, 127.5, 0.01) << options.network;
    EXPECT_NEAR(seen[0].box_px.y, 95.5, 0.01);
    EXPECT_NEAR(seen[0].box_px.width, 16, 0.01);
    EXPECT_GT(seen[0].confidence, 0.9f);
    EXPECT_EQ(detector.labelOf(seen[0].kind), "red thing");
    EXPECT_EQ(detector.labelOf(3), "class 3");
    EXPECT_TRUE(detector.detect(cv::Mat(256, 256, CV_8UC1, cv::Scalar(128))).empty());
  }
}

TEST(Detector, ReadsWeightsOfTheOldHeader) {
  const TinyFiles files;
  writeFile(files.folder.file("tiny.weights"), tinyDarknetWeights(1));
  EXPECT_EQ(Detector(files.darknet).detect(redSquare().left).size(), 1u);
  const std::string bytes = tinyDarknetWeights(1);
  writeFile(files.folder.file("tiny.weights"), bytes.substr(0, bytes.size() - 4));
  EXPECT_NE(errorOf([&] { Detector detector(files.darknet); }).find("tiny.weights: has"), std::string::npos);
}

TEST(Detector, LeavesBoxesThatAreNowhere) {
  const TinyFiles files;
  for (const float side : {1000.f, std::numeric_limits<float>::quiet_NaN()}) {
    writeFile(files.folder.file("tiny.weights"), tinyDarknetWeights(2, side));
    EXPECT_TRUE(Detector(files.darknet).detect(redSquare().left).empty()) << side;
  }
}

TEST(Detector, RefusesUnreadableFiles) {
  const TinyFiles files;
  const auto error = [](DetectorOptions options) { return errorOf([&] { Detector detector(options); }); };
  DetectorOptions bad = files.darknet;
  bad.weights = files.folder.file("missing.weights");
  EXPECT_NE(error(bad).find("missing.weights: cannot be read"), std::string::npos) << error(bad);
  bad.weights = files.folder.file("short.weights");
  for (const std::size_t bytes : {0ul, 12ul, 30ul, 200ul, tinyDarknetWeights().size() - 4}) {
    writeFile(bad.weights, tinyDarknetWeights().substr(0, bytes));
    EXPECT_NE(error(bad).find("short.weights"), std::string::npos) << bytes << ": " << error(bad);
  }
  bad = files.onnx;
  bad.network = files.folder.file("half.onnx");
  writeFile(bad.network, tinyOnnx().substr(0, tinyOnnx().size() / 2));
  EXPECT_NE(error(bad).find("half.onnx: "), std::string::npos) << error(bad);
  EXPECT_EQ(error(bad).find('\n'), std::string::npos);
  bad.network = files.folder.file("names");
  EXPECT_NE(error(bad).find("allowed: a .cfg (Darknet) or .onnx file"), std::string::npos);
  bad.network = files.folder.file("empty.cfg");
  bad.weights = files.folder.file("tiny.weights");
  writeFile(bad.network, "no network at all");
  EXPECT_NE(error(bad).find("empty.cfg: "), std::string::npos) << error(bad);
}

TEST(BoxRange, ByCentersAndByTheDenseMap) {
  StereoCalibration rig;
  rig.focal_px = 256;
  rig.cx_px = rig.cy_px = 127.5;
  rig.baseline_m = 0.1;
  StereoResult dense;
  dense.disparity = cv::Mat(256, 256, CV_32F, cv::Scalar(4));
  dense.disparity(cv::Rect(128, 96, 16, 16)).setTo(16.5f);
  const auto map = [&]() -> const StereoResult& { return dense; };
  const auto label = [](int) { return std::string("thing"); };
  Boxes boxes{{{0, 1, {127.5f, 95.5f, 16, 16}}},
              {{1, 1, {111.5f, 95.5f, 16, 16}}, {0, 1, {111.5f, 97.5f, 16, 16}}}};
  const SparseResult centers = rangeBoxes(boxes, rig, BoxRanging::kCenters, map, label);
  ASSERT_TRUE(centers.objects.at(0).found());
  EXPECT_NEAR(centers.objects[0].point_m.z, 25.6 / 16, 1e-6);
  const SparseResult surface = rangeBoxes(boxes, rig, BoxRanging::kDense, map, label);
  ASSERT_TRUE(surface.objects.at(0).found()) << surface.objects[0].why_not;
  EXPECT_NEAR(surface.objects[0].point_m.z, 25.6 / 16.5, 1e-3);
  boxes.right.pop_back();  // what is left is of another class
  EXPECT_EQ(rangeBoxes(boxes, rig, BoxRanging::kCenters, map, label).objects.at(0).why_not,
            "the right view has no box to pair it with");
}

class LogoRangePlugin : public ::testing::Test {
 protected:
  SparseResult run(const RectifiedPair& pair, const StereoCalibration& rig,
                   const std::vector<std::string>& values) {
    PluginSettings settings = plugin_.settings();
    settings.assign(values);
    return plugin_.run(pair.left, pair.right, rig, settings);
  }
  LoadedPlugin plugin_{POMONA_LOGO_RANGE};
  TemporaryFolder folder_;
};

TEST_F(LogoRangePlugin, SaysWhatItsFaithfulFeaturesAre) {
  const std::vector<FeatureKind> kinds = featureKinds();
  const bool has_surf = std::find(kinds.begin(), kinds.end(), FeatureKind::kSurf128) != kinds.end();
  const ParameterSet faithful = plugin_.parameterSets().at(0);
  PluginSettings settings = plugin_.settings();
  settings.set("variant", "faithful");
  EXPECT_EQ(settings.text("features"), has_surf ? "surf-128" : "sift");
  EXPECT_NE(faithful.description.find(has_surf ? "by surf-128" : "by sift in place of surf-128"),
            std::string::npos)
      << faithful.description;
}

TEST_F(LogoRangePlugin, LearnsOnceAndKeepsTheDatabase) {
  const Street s = street(3, 20, signPicture());
  const RectifiedPair pair{s.pair.left.image, s.pair.right.image};
  const std::string picture = folder_.file("fruit shop.png"), database = folder_.file("signs.objects");
  writeFile(picture, encodeImage(signPicture()));
  const SparseResult first =
      run(pair, s.pair.calibration, {"objects=" + picture, "save_objects=" + database});
  ASSERT_TRUE(first.objects.at(0).found()) << first.objects[0].why_not;
  EXPECT_EQ(first.objects[0].label, "fruit shop");
  const SparseResult again = run(pair, s.pair.calibration, {"objects=" + database});
  EXPECT_EQ(again.objects.at(0).distance_m, first.objects[0].distance_m);
  const SparseResult faithful = run(pair, s.pair.calibration, {"variant=faithful", "objects=" + picture});
  ASSERT_TRUE(faithful.objects.at(0).found()) << faithful.objects[0].why_not;
  EXPECT_NEAR(faithful.objects[0].distance_m, cv::norm(s.middle_m), 0.1 * 3);
}

// Wide signs, of which one end is much nearer than the other: what was matched at one end must not decide
// where the middle is.
TEST_F(LogoRangePlugin, RangesTheMiddleOfWideSigns) {
  const std::string picture = folder_.file("sign.png");
  for (const std::uint64_t seed : {401, 402, 403}) {
    const StreetSign sign = streetSign(seed, true);
    writeFile(picture, encodeImage(sign.picture));
    const double yaw_deg = seed == 402 ? -40 : 40;
    const SignScene scene = signScene(sign, 7, yaw_deg, seed + 10);
    const SparseObject object =
        run({scene.pair.left.image, scene.pair.right.image}, scene.pair.calibration, {"objects=" + picture})
            .objects.at(0);
    ASSERT_TRUE(object.found()) << seed << ": " << object.why_not;
    EXPECT_NEAR(object.distance_m, scene.distance_m, 0.02 * scene.distance_m) << seed;
  }
}

TEST_F(LogoRangePlugin, LearnsAPictureAgainThatChanged) {
  const Street s = street(3, 0, signPicture());
  const RectifiedPair pair{s.pair.left.image, s.pair.right.image};
  const std::string picture = folder_.file("sign.png");
  writeFile(picture, encodeImage(coverPicture(2)));
  EXPECT_FALSE(run(pair, s.pair.calibration, {"objects=" + picture}).objects.at(0).found());
  writeFile(picture, encodeImage(signPicture()));
  EXPECT_TRUE(run(pair, s.pair.calibration, {"objects=" + picture}).objects.at(0).found());
}

TEST_F(LogoRangePlugin, SaysWhatIsWrong) {
  const RectifiedPair pair = redSquare();
  StereoCalibration rig;
  rig.focal_px = 256;
  rig.baseline_m = 0.1;
  const auto error = [&](const std::vector<std::string>& values) {
    return errorOf([&] { run(pair, rig, values); });
  };
  EXPECT_NE(error({}).find("logo-range: objects is ''; allowed:"), std::string::npos) << error({});
  EXPECT_NE(error({"objects=,a.png"}).find("empty name"), std::string::npos) << error({"objects=,a.png"});
  EXPECT_NE(error({"objects=/nowhere.png"}).find("/nowhere.png"), std::string::npos);
  EXPECT_NE(error({"network=/nowhere.cfg"}).find("/nowhere.cfg: cannot be read"), std::string::npos)
      << error({"network=/nowhere.cfg"});
  EXPECT_NE(error({"ratio=3"}).find("allowed: 0 to 1"), std::string::npos);
}

TEST_F(LogoRangePlugin, RangesADetectorsBoxes) {
  const TinyFiles files;
  StereoCalibration rig;
  rig.focal_px = 256;
  rig.baseline_m = 0.1;
  const SparseResult result = run(redSquare(), rig,
                                  {"network=" + files.darknet.network, "input_size_px=64",
                                   "labels=" + files.darknet.labels, "box_ranging=centers"});
  ASSERT_EQ(result.objects.size(), 1u);
  ASSERT_TRUE(result.objects[0].found()) << result.objects[0].why_not;
  EXPECT_EQ(result.objects[0].label, "red thing");
  EXPECT_NEAR(result.objects[0].point_m.z, 1.6, 1e-4);
}

TEST_F(LogoRangePlugin, FindsAlteredPicturesInRealPairs) {
  const char* const scenes = std::getenv("POMONA_DATASETS");
  if (!scenes) GTEST_SKIP() << "set POMONA_DATASETS to a folder with middlebury/<scene>/";
  for (const RealQuery& query : realQueries()) {
    const RealPair real = realPair(query, scenes);
    const std::string picture = folder_.file(query.scene + ".png");
    writeFile(picture, encodeImage(pictureOf(query, real.left)));
    const SparseResult result = run({real.left, real.right}, real.calibration, {"objects=" + picture});
    std::filesystem::remove(picture);
    const SparseObject& object = result.objects.at(0);
    ASSERT_TRUE(object.found()) << query.scene << " " << query.label << ": " << object.why_not;
    EXPECT_NEAR(disparityOf(real.calibration, object.point_m.z), real.truth_px, 0.02 * real.truth_px)
        << query.scene << " " << query.label;
  }
}

}  // namespace
}  // namespace pomona
