#include "pomona/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "camera/seen_share.h"
#include "camera/sphere_fit.h"
#include "file_support.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 320, kHeight = 240;

StereoCalibration camera() {
  StereoCalibration c;
  c.focal_px = 1000;
  c.cx_px = 160;
  c.cy_px = 120;
  c.baseline_m = 0.12;
  c.doffs_px = 3;
  c.width = kWidth;
  c.height = kHeight;
  return c;
}

cv::Vec3d rayOf(double x, double y) {
  const StereoCalibration c = camera();
  const cv::Vec3d ray((x - c.cx_px) / c.focal_px, (y - c.cy_px) / c.focal_px, 1);
  return ray * (1 / cv::norm(ray));
}

// A disparity map to put objects into, nearest wins; all of it measured.
class World {
 public:
  World() : depth_(kHeight, kWidth, 1e9) {}

  // `height`: of its upright half axis, as a share of the radius.
  void addSphere(const cv::Vec3d& center, double radius, double height = 1) {
    const cv::Vec3d stretched(center[0], center[1] / height, center[2]);
    forAll([&](int x, int y) {
      const cv::Vec3d ray(rayOf(x, y)[0], rayOf(x, y)[1] / height, rayOf(x, y)[2]);
      const double along = ray.dot(stretched) / ray.dot(ray);
      const double inside = along * along - (stretched.dot(stretched) - radius * radius) / ray.dot(ray);
      return inside > 0 ? (along - std::sqrt(inside)) * ray[2] : 1e9;
    });
  }
  void addPlane(const cv::Rect& where, double depth_m, double slope_m_per_px = 0) {
    forAll([&](int x, int y) {
      return where.contains({x, y}) ? depth_m + slope_m_per_px * (x - where.x) : 1e9;
    });
  }

  // Errors of `noise_px`, alike over about `alike_px` pixels in each direction.
  StereoResult result(double noise_px = 0, std::uint64_t seed = 1, int alike_px = 7) const {
    const StereoCalibration c = camera();
    StereoResult r;
    r.disparity = cv::Mat(kHeight, kWidth, CV_32F);
    cv::Mat noise(kHeight, kWidth, CV_32F);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, 1);
    cv::Mat smooth = noise.clone();
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {  // the mean of a window, scaled back to unit variance
        const cv::Rect window = cv::Rect(x - alike_px / 2, y - alike_px / 2, alike_px, alike_px) &
                                cv::Rect(0, 0, kWidth, kHeight);
        smooth.at<float>(y, x) =
            static_cast<float>(cv::sum(noise(window))[0] / std::sqrt(static_cast<double>(window.area())));
      }
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        r.disparity.at<float>(y, x) =
            depth_(y, x) > 1e8 ? kNan
                               : static_cast<float>(c.focal_px * c.baseline_m / depth_(y, x) - c.doffs_px +
                                                    noise_px * smooth.at<float>(y, x));
    r.state = cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(0));
    r.confidence = cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(0.95));
    r.sigma_px = cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(std::max(0.1, noise_px)));
    return r;
  }

 private:
  template <typename DepthAt>
  void forAll(const DepthAt& depth_at) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) depth_(y, x) = std::min(depth_(y, x), depth_at(x, y));
  }
  cv::Mat1d depth_;
};

constexpr double kRadius_m = 0.04;
const cv::Vec3d kCenter(0.02, -0.015, 0.8);  // seen around (185, 101.25), 50 px wide on each side
const cv::Rect kBox(135, 51, 101, 101);

// Nearer than `relative` of the truth, and within three of what it says of itself.
void expectSphere(const ObjectMeasurement& m, double relative = 0.003) {
  ASSERT_TRUE(m.ok()) << explain(m.failure);
  const double center_m = cv::norm(kCenter), near_m = center_m - kRadius_m;
  EXPECT_NEAR(m.distance_m, near_m, relative * near_m);
  EXPECT_NEAR(m.center_distance_m, center_m, 2 * relative * near_m);
  EXPECT_LT(std::abs(m.distance_m - near_m), 3 * m.distance_sigma_m);
  EXPECT_LT(std::abs(m.center_distance_m - center_m), 3 * m.center_sigma_m);
  EXPECT_LT(cv::norm(m.near_point_m - kCenter * (near_m / center_m)), 0.006);
  EXPECT_NEAR(m.azimuth_rad, 0.025, 0.005);
  EXPECT_NEAR(m.elevation_rad, 0.01875, 0.005);
  EXPECT_NEAR(cv::norm(m.near_point_m), m.distance_m, 1e-9);
  EXPECT_LT(m.distance_sigma_m, 0.01 * near_m);
}

TEST(MeasureObject, MeasuresASphereInEveryKindOfRegion) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  world.addPlane({0, 0, kWidth, kHeight}, 1.5);
  const StereoResult result = world.result();
  cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(0));
  mask(kBox) = 255;
  const Polygon diamond = {{185, 35}, {251, 101}, {185, 167}, {119, 101}};
  const Region regions[] = {kBox, Circle{{185, 101}, 51}, diamond, mask};
  for (std::size_t i = 0; i < std::size(regions); ++i) {
    SCOPED_TRACE(i);
    const ObjectMeasurement m = measureObject(result, camera(), regions[i]);
    expectSphere(m, 0.001);
    EXPECT_NEAR(m.radius_m, kRadius_m, 0.001);
    EXPECT_GT(m.support_px, 3000);
    EXPECT_GT(m.support_share, 0.3);
    EXPECT_LE(m.support_share, 1);
  }
}

TEST(MeasureObject, LeavesInFrontAndNeighboursBesideMakeNoDifference) {
  World leaves;
  leaves.addSphere(kCenter, kRadius_m);
  leaves.addPlane({130, 70, 60, 35}, 0.70, 2e-4);  // across the middle
  leaves.addPlane({190, 110, 60, 60}, 0.72, -1e-4);
  leaves.addPlane({0, 0, kWidth, kHeight}, 1.1);
  expectSphere(measureObject(leaves.result(0.1), camera(), kBox));

  World touching;
  touching.addSphere(kCenter, kRadius_m);
  touching.addSphere(kCenter + cv::Vec3d(0.06, 0.02, -0.04), kRadius_m);
  touching.addPlane({0, 0, kWidth, kHeight}, 0.9);
  expectSphere(measureObject(touching.result(0.1), camera(), kBox));
}

// Far away a fruit is nearly flat, and a leaf across its middle shows more pixels; but the fruit is seen
// beside it, where a sphere in the leaf's place would hide it.
TEST(MeasureObject, NothingIsSeenThroughAFruit) {
  World world;
  world.addSphere({0, 0, 2}, kRadius_m);  // 20 px
  world.addPlane({153, 95, 40, 50}, 1.8);
  const ObjectMeasurement m = measureObject(world.result(), camera(), cv::Rect(140, 100, 41, 41));
  ASSERT_TRUE(m.ok());
  EXPECT_NEAR(m.distance_m, 1.96, 0.01);
}

TEST(MeasureObject, NeedsNoBackgroundAndNotAllOfTheObject) {
  World alone;
  alone.addSphere(kCenter, kRadius_m);
  expectSphere(measureObject(alone.result(0.1), camera(), kBox));

  StereoResult half = alone.result(0.1);
  half.disparity.colRange(0, 185) = kNan;
  expectSphere(measureObject(half, camera(), kBox));
  // A box around what is left.
  expectSphere(measureObject(half, camera(), cv::Rect(185, 51, 51, 101)), 0.005);
}

TEST(MeasureObject, BelievesWhatWasMeasuredRatherThanWhatWasFilled) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  StereoResult result = world.result(0.1);
  const cv::Rect filled(135, 51, 101, 60);
  result.disparity(filled) = 90;
  result.state(filled) = static_cast<int>(PixelState::kFilledInterpolated);
  result.confidence(filled) = 0.48;
  result.sigma_px(filled) = 16;
  expectSphere(measureObject(result, camera(), kBox), 0.005);
}

// Far away, a leaf 2 cm before a fruit is less than a pixel nearer: both are to be tried.
TEST(MeasureObject, TellsAFarFruitFromALeafLessThanAPixelBeforeIt) {
  constexpr double kDepth_m = 1.85, kFruitRadius_m = 0.042, kNear_m = kDepth_m - kFruitRadius_m;
  for (const double gap_m : {0.015, 0.02, 0.025})
    for (const int height : {22, 34, 46})
      for (const int x : {139, 149, 157}) {
        World world;
        world.addSphere({0, 0, kDepth_m}, kFruitRadius_m, 0.9);
        world.addPlane({x, 120 - height / 2, 22, height}, kNear_m - gap_m, 0.0003);
        world.addPlane({0, 0, kWidth, kHeight}, 2.3);
        const ObjectMeasurement m = measureObject(world.result(0.12), camera(), cv::Rect(137, 97, 47, 47));
        SCOPED_TRACE(::testing::Message() << gap_m << ' ' << height << ' ' << x);
        ASSERT_TRUE(m.ok()) << explain(m.failure);
        EXPECT_NEAR(m.distance_m, kNear_m, 0.006 * kNear_m);
      }
}

// Apples are no spheres: what lies a little behind the sphere is not seen through it, even if a leaf hides
// most of the fruit.
TEST(MeasureObject, FindsAFlatFruitBehindALeaf) {
  const cv::Vec3d center(0, 0, 0.45);
  World world;
  world.addSphere(center, kRadius_m, 0.86);
  world.addPlane({120, 76, 80, 88}, 0.39);
  world.addPlane({0, 0, kWidth, kHeight}, 1.1);
  const ObjectMeasurement m = measureObject(world.result(), camera(), cv::Rect(71, 44, 179, 153));
  ASSERT_TRUE(m.ok()) << explain(m.failure);
  EXPECT_NEAR(m.distance_m, cv::norm(center) - kRadius_m, 0.004);
}

// Filled pixels are guesses, often the background's: they are not seen through the sphere.
TEST(MeasureObject, IsNotTalkedOutOfASphereByFilledBackground) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  StereoResult result = world.result(0.1);
  const cv::Rect filled(135, 51, 101, 68);
  result.disparity(filled) = 57;
  result.state(filled) = static_cast<int>(PixelState::kFilledBackground);
  result.confidence(filled) = 0.9;
  expectSphere(measureObject(result, camera(), kBox), 0.01);
}

// What the left view shows at (x, y) is to be guessed: as if the right view had not seen it.
void hide(StereoResult& result, const cv::Rect& where, float disparity) {
  result.disparity(where) = disparity;
  result.state(where) =
      static_cast<int>(std::isnan(disparity) ? PixelState::kOutOfRange : PixelState::kFilledBackground);
  result.confidence(where) = std::isnan(disparity) ? 0 : 0.6;
}

// The middle of the region was not measured; what was measured at its edge is a neighbour.
TEST(MeasureObject, DoesNotTakeANeighbourForWhatOnlyOneCameraSees) {
  World world;
  world.addSphere(kCenter + cv::Vec3d(0.06, 0, -0.03), kRadius_m);
  world.addPlane({0, 0, kWidth, kHeight}, 1.5);
  for (const float guess : {kNan, 77.0f}) {
    SCOPED_TRACE(guess);
    StereoResult result = world.result(0.1);
    hide(result, {100, 0, 100, kHeight}, guess);
    EXPECT_EQ(measureObject(result, camera(), kBox).failure, MeasureFailure::kUnseen);
    cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(0));
    mask(cv::Rect(135, 51, 70, 101)) = 255;
    EXPECT_EQ(measureObject(result, camera(), mask).failure, MeasureFailure::kUnseen);
    MeasureOptions options;
    options.shape = ObjectShape::kSurface;
    EXPECT_EQ(measureObject(result, camera(), mask, options).failure, MeasureFailure::kUnseen);
  }
}

// At 0.76 m, partners of the columns up to 154 lie outside of the right view.
TEST(MeasureObject, MeasuresWhatReachesOutOfTheRightView) {
  const cv::Vec3d center(-0.03, -0.015, 0.8);
  World world;
  world.addSphere(center, kRadius_m);
  StereoResult result = world.result(0.1);
  hide(result, {0, 0, 152, kHeight}, kNan);
  MeasureOptions options;
  options.radius_m = kRadius_m;
  options.radius_sigma_m = 0.002;
  const ObjectMeasurement m = measureObject(result, camera(), cv::Rect(72, 51, 101, 101), options);
  ASSERT_TRUE(m.ok()) << explain(m.failure);
  const double near_m = cv::norm(center) - kRadius_m;
  EXPECT_NEAR(m.distance_m, near_m, 0.005 * near_m);
}

// With cameras that converge, things far away have partners beyond the right border, too.
TEST(SeenShare, LeavesOutWhatTheRightViewCannotSee) {
  constexpr double kParallax_px = 40, kReach_px = 1;
  StereoCalibration calibration = camera();
  const auto shareWithUnmeasuredAt = [&](double x_px, double doffs_px) {
    calibration.doffs_px = doffs_px;
    RegionSamples region;
    region.view_width_px = kWidth;
    SurfaceSample seen{};
    seen.parallax_px = kParallax_px;
    seen.centrality = 1;
    seen.measured = true;
    region.samples.push_back(seen);
    region.unmeasured.push_back({rayOf(x_px, 120), x_px, 1});
    const auto everywhere = [&](const cv::Vec3d&) { return std::optional(kParallax_px); };
    return seenShare(region, calibration, everywhere, kReach_px);
  };
  EXPECT_DOUBLE_EQ(shareWithUnmeasuredAt(36, 3), 1);
  EXPECT_DOUBLE_EQ(shareWithUnmeasuredAt(37, 3), 0.5);
  EXPECT_DOUBLE_EQ(shareWithUnmeasuredAt(kWidth - 1, 3), 0.5);
  EXPECT_DOUBLE_EQ(shareWithUnmeasuredAt(kWidth - 20, 60), 1);
  EXPECT_DOUBLE_EQ(shareWithUnmeasuredAt(kWidth - 21, 60), 0.5);
}

TEST(ParallaxAlong, IsThatOfTheNearSideAndNoneElsewhere) {
  const cv::Vec3d ahead(0, 0, 1);
  const auto parallax = [&](double depth_m) {
    FittedSphere sphere;
    sphere.center_m = {0, 0, depth_m};
    sphere.radius_m = 0.1;
    return parallaxAlong(ahead, sphere, camera());
  };
  ASSERT_TRUE(parallax(0.5).has_value());
  EXPECT_NEAR(*parallax(0.5), 1000 * 0.12 / 0.4, 1e-9);
  EXPECT_FALSE(parallax(0.05).has_value());  // the camera is inside
  EXPECT_FALSE(parallax(-0.5).has_value());
  FittedSphere beside;
  beside.center_m = {0.2, 0, 0.5};
  beside.radius_m = 0.1;
  EXPECT_FALSE(parallaxAlong(ahead, beside, camera()).has_value());
}

TEST(MeasureObject, NeedsNoMapsButTheDisparity) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  StereoResult bare;
  bare.disparity = world.result().disparity;
  expectSphere(measureObject(bare, camera(), kBox));
}

TEST(MeasureObject, ARadiusThatIsKnownTellsTheCentreOfASliver) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  StereoResult result = world.result(0.3, 5);
  result.disparity.colRange(0, 205) = kNan;
  const cv::Rect box(205, 51, 31, 101);
  MeasureOptions options;
  const ObjectMeasurement unknown = measureObject(result, camera(), box, options);
  options.radius_m = kRadius_m;
  options.radius_sigma_m = 0.001;
  const ObjectMeasurement known = measureObject(result, camera(), box, options);
  ASSERT_TRUE(unknown.ok() && known.ok());
  EXPECT_NEAR(known.radius_m, kRadius_m, 0.003);
  EXPECT_LT(known.radius_sigma_m, unknown.radius_sigma_m);
  EXPECT_NEAR(known.center_distance_m, cv::norm(kCenter), 3 * known.center_sigma_m);
}

TEST(MeasureObject, ASphereThatIsLargerThanItsRegionIsLessSure) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  const StereoResult result = world.result();
  const cv::Rect tight(147, 63, 77, 77);  // 3/4 of its 50 px each way
  MeasureOptions options;
  const ObjectMeasurement whole = measureObject(result, camera(), kBox, options);
  const ObjectMeasurement part = measureObject(result, camera(), tight, options);
  options.radius_m = kRadius_m;
  options.radius_sigma_m = 0.004;
  const ObjectMeasurement known = measureObject(result, camera(), tight, options);
  ASSERT_TRUE(whole.ok() && part.ok() && known.ok());
  const double excess_m = part.radius_m * 0.2;
  ASSERT_GT(part.radius_m, 0.9 * kRadius_m);
  EXPECT_GT(part.distance_sigma_m, 0.7 * excess_m);
  EXPECT_LT(whole.distance_sigma_m, 0.5 * part.distance_sigma_m);
  EXPECT_LT(known.distance_sigma_m, 0.5 * part.distance_sigma_m);
}

// Errors that neighbours share do not average out as independent ones would: the stated interval must know.
TEST(MeasureObject, TwoSigmaHoldMostOfTheTime) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  world.addPlane({0, 0, kWidth, kHeight}, 1.2);
  int near = 0, center = 0;
  constexpr int kRuns = 60;
  double sigma_m = 0, squares_m2 = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const ObjectMeasurement m = measureObject(world.result(0.7, seed, 11), camera(), kBox);
    ASSERT_TRUE(m.ok());
    const double error_m = m.distance_m - (cv::norm(kCenter) - kRadius_m);
    near += std::abs(error_m) <= 2 * m.distance_sigma_m;
    center += std::abs(m.center_distance_m - cv::norm(kCenter)) <= 2 * m.center_sigma_m;
    sigma_m += m.distance_sigma_m / kRuns;
    squares_m2 += error_m * error_m / kRuns;
  }
  EXPECT_GE(near, 0.9 * kRuns);
  EXPECT_GE(center, 0.9 * kRuns);
  EXPECT_LT(sigma_m, 4 * std::sqrt(squares_m2));  // and it does not hide behind large intervals
}

TEST(MeasureObject, MeasuresSurfacesOfAnyShape) {
  World world;
  world.addPlane({100, 60, 120, 100}, 0.9);
  world.addPlane({0, 0, kWidth, kHeight}, 1.4);
  MeasureOptions options;
  options.shape = ObjectShape::kSurface;
  const ObjectMeasurement m = measureObject(world.result(0.2), camera(), cv::Rect(95, 55, 130, 110), options);
  ASSERT_TRUE(m.ok()) << explain(m.failure);
  EXPECT_NEAR(m.near_point_m[2], 0.9, 0.003);
  EXPECT_NEAR(m.near_point_m[2], 0.9, 3 * m.distance_sigma_m);
  EXPECT_TRUE(std::isnan(m.center_distance_m) && std::isnan(m.radius_m));
}

TEST(MeasureObject, SaysWhyItCannot) {
  World world;
  world.addSphere(kCenter, kRadius_m);
  StereoResult result = world.result();
  const auto failureOf = [&](const Region& region) {
    const ObjectMeasurement m = measureObject(result, camera(), region);
    EXPECT_TRUE(std::isnan(m.distance_m) || m.ok());
    return m.failure;
  };
  EXPECT_EQ(failureOf(kBox), MeasureFailure::kNone);
  EXPECT_EQ(failureOf(cv::Rect(-200, 0, 100, 100)), MeasureFailure::kOutside);
  EXPECT_EQ(failureOf(Circle{{1000, 100}, 30}), MeasureFailure::kOutside);
  EXPECT_EQ(failureOf(cv::Rect(0, 180, 100, 50)), MeasureFailure::kUnmatched);
  EXPECT_EQ(failureOf(cv::Rect(180, 100, 6, 6)), MeasureFailure::kUnmatched);  // fewer than 40 px
  result.disparity = -3.5f;
  EXPECT_EQ(failureOf(kBox), MeasureFailure::kInfinite);
  cv::RNG(1).fill(result.disparity, cv::RNG::UNIFORM, 10, 300);
  EXPECT_EQ(failureOf(kBox), MeasureFailure::kScattered);
  for (int i = 0; i <= static_cast<int>(MeasureFailure::kUnseen); ++i)
    EXPECT_NE(explain(static_cast<MeasureFailure>(i)), "unknown");
}

TEST(MeasureObject, RefusesWhatIsNotValid) {
  const StereoResult result = World().result();
  const auto refused = [&](const Region& region, const char* part) {
    expectContains(messageOf<std::invalid_argument>([&] { measureObject(result, camera(), region); }), part);
  };
  refused(cv::Rect(3, 3, 0, 5), "box");
  refused(Circle{{3, 3}, 0}, "radius must be above 0");
  refused(Circle{{3, 3}, 1e9}, "larger than any image");
  refused(Circle{{std::nan(""), 3}, 1}, "centre");
  refused(Polygon{{0, 0}, {1, 1}}, "three corners");
  refused(Polygon{{0, 0}, {1, std::nan("")}, {2, 2}}, "corner");
  refused(cv::Mat(10, 10, CV_8U, cv::Scalar(1)), "mask");
  refused(cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(0)), "0 everywhere");
  MeasureOptions options;
  options.radius_m = 0.04;
  EXPECT_THROW(measureObject(result, camera(), kBox, options), std::invalid_argument);
  options = {};
  options.min_support_px = 0;
  EXPECT_THROW(measureObject(result, camera(), kBox, options), std::invalid_argument);
  StereoResult odd = World().result();
  odd.sigma_px = cv::Mat(3, 3, CV_32F);
  expectContains(messageOf<std::invalid_argument>([&] { measureObject(odd, camera(), kBox); }), "sigma_px");
  StereoCalibration small = camera();
  small.width /= 2;
  EXPECT_THROW(measureObject(result, small, kBox), std::invalid_argument);
}

TEST(MeasurePoint, IsThePixelsPoint) {
  World world;
  world.addPlane({0, 0, kWidth, kHeight}, 0.9);
  StereoResult result = world.result();
  result.sigma_px = 0.2f;
  const PointMeasurement m = measurePoint(result, camera(), 259.6, 119.5);
  ASSERT_TRUE(m.ok());
  EXPECT_LT(cv::norm(m.point_m - cv::Vec3d(0.09, 0, 0.9)), 1e-5);
  EXPECT_NEAR(m.distance_m, cv::norm(m.point_m), 1e-12);
  EXPECT_NEAR(m.distance_sigma_m, m.distance_m * 0.2 / (1000 * 0.12 / 0.9), 1e-6);
  EXPECT_EQ(m.state, PixelState::kMeasured);

  result.disparity.at<float>(10, 20) = kNan;
  result.state.at<std::uint8_t>(10, 20) = static_cast<std::uint8_t>(PixelState::kOccluded);
  EXPECT_EQ(measurePoint(result, camera(), 20, 10).failure, MeasureFailure::kUnmatched);
  EXPECT_EQ(measurePoint(result, camera(), 20, 10).state, PixelState::kOccluded);
  EXPECT_EQ(measurePoint(result, camera(), -1, 10).failure, MeasureFailure::kOutside);
  EXPECT_EQ(measurePoint(result, camera(), 319.6, 10).failure, MeasureFailure::kOutside);
  EXPECT_EQ(measurePoint(result, camera(), std::nan(""), 10).failure, MeasureFailure::kOutside);
  result.disparity = -3.0f;
  EXPECT_EQ(measurePoint(result, camera(), 20, 10).failure, MeasureFailure::kInfinite);
}

}  // namespace
}  // namespace pomona
