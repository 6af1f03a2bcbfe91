// The renderer's parts: shapes against their equations, the grid and the masks against brute force, what
// cameras do to light, and the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "datasets/hash.h"
#include "datasets/render.h"
#include "datasets/rendering/angle.h"
#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/orchard.h"
#include "datasets/rendering/paint.h"
#include "datasets/rendering/ray_grid.h"
#include "datasets/rendering/solid.h"
#include "datasets/rendering/storefront.h"

namespace pomona {
namespace {

using cv::Vec3d;

class RandomVectors {
 public:
  explicit RandomVectors(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return random_.between(low, high); }
  Vec3d within(double size) {
    return Vec3d{between(-size, size), between(-size, size), between(-size, size)};
  }

 private:
  Random random_;
};

Vec3d unit(const Vec3d& v) {
  return v / cv::norm(v);
}

// A curved surface of each kind, somewhere before the camera.
Surface someSurface(Shape shape, RandomVectors& random) {
  Surface s;
  s.shape = shape;
  s.center = Vec3d(0, 0, 2) + random.within(0.3);
  const Vec3d axis = unit(random.within(1)), side = unit(axis.cross(random.within(1)));
  s.u = axis * random.between(0.2, 0.5);
  s.v = (shape == Shape::kLeaf ? side : axis) * random.between(0.2, 0.5);
  s.radius_m = random.between(0.05, 0.4);
  s.taper = shape == Shape::kBranch ? random.between(-0.5, 0.5) : 0;
  s.bend_u_m = random.between(-0.3, 0.3);
  s.bend_v_m = random.between(-0.3, 0.3);
  return s;
}

// The equation of the surface, zero on it, and whether a place on it is inside of its outline: straight from
// the words of render.h.
double equation(const Surface& s, const Vec3d& p) {
  const Vec3d from_center = p - s.center;
  if (s.shape == Shape::kLeaf) {
    const double a = from_center.dot(s.u) / s.u.dot(s.u), b = from_center.dot(s.v) / s.v.dot(s.v);
    return from_center.dot(unit(s.u.cross(s.v))) - s.bend_u_m * a * a - s.bend_v_m * b * b;
  }
  const double along = from_center.dot(unit(s.v)), aside = cv::norm(from_center - unit(s.v) * along);
  const double c = along / cv::norm(s.v);
  if (s.shape == Shape::kBranch) return aside - s.radius_m * (1 - s.taper * c);
  return c * c + aside * aside / (s.radius_m * s.radius_m) - 1;
}
bool isInside(const Surface& s, const Vec3d& p) {
  const Vec3d from_center = p - s.center;
  if (s.shape == Shape::kBranch) return std::abs(from_center.dot(s.v)) <= s.v.dot(s.v);
  if (s.shape != Shape::kLeaf) return true;
  const double a = from_center.dot(s.u) / s.u.dot(s.u), b = from_center.dot(s.v) / s.v.dot(s.v);
  return std::abs(a) <= 1 && std::abs(b) <= (1 - a * a) * (1 - 0.45 * a);
}

// The first root along the ray by steps of half a millimetre, then by halving.
double marched(const Surface& s, const Vec3d& direction) {
  constexpr double kStep = 0.0005;
  for (double t = 1e-3; t < 4; t += kStep) {
    double low = t, high = t + kStep;
    const double before = equation(s, direction * low);
    if ((before < 0) == (equation(s, direction * high) < 0)) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      ((equation(s, direction * middle) < 0) == (before < 0) ? low : high) = middle;
    }
    if (isInside(s, direction * low)) return low;
  }
  return kNowhere;
}

TEST(Solid, CurvedShapesAreMetWhereTheirEquationsSay) {
  RandomVectors random(1);
  for (const Shape shape : {Shape::kSpheroid, Shape::kBranch, Shape::kLeaf}) {
    int hits = 0, differ = 0;
    for (int i = 0; i < 400; ++i) {
      const Surface surface = someSurface(shape, random);
      const Vec3d aim = surface.center + random.within(0.4), direction = aim / aim[2];
      const double depth = Solid(surface, 0).depthAlong({0, 0, 0}, direction);
      const double expected = marched(surface, direction);
      if (depth != kNowhere) {
        ++hits;
        EXPECT_NEAR(equation(surface, direction * depth), 0, 1e-9) << "shape " << int(shape) << ", " << i;
      }
      // Marching steps over grazing rays.
      differ +=
          (depth == kNowhere) != (expected == kNowhere) || (depth < 10 && std::abs(depth - expected) > 1e-9);
    }
    EXPECT_GT(hits, 80) << int(shape);
    EXPECT_LE(differ, 3) << int(shape);
  }
}

TEST(Solid, BoundsHoldAndNormalsPointUpTheSlope) {
  RandomVectors random(2);
  for (const Shape shape : {Shape::kSpheroid, Shape::kBranch, Shape::kLeaf})
    for (int i = 0; i < 2000; ++i) {
      const Surface surface = someSurface(shape, random);
      const Solid solid(surface, 0);
      const Vec3d aim = surface.center + random.within(0.4), direction = aim / aim[2];
      const double depth = solid.depthAlong({0, 0, 0}, direction);
      if (depth == kNowhere) continue;
      const Vec3d p = direction * depth;
      const Bounds bounds = solid.bounds();
      Vec3d slope;
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(p[k], bounds.low[k] - 1e-9);
        EXPECT_LE(p[k], bounds.high[k] + 1e-9);
        Vec3d step;
        step[k] = 1e-6;
        slope[k] = equation(surface, p + step) - equation(surface, p - step);
      }
      EXPECT_NEAR(std::abs(solid.normalAt(p).dot(unit(slope))), 1, 1e-5) << int(shape) << ", " << i;
    }
}

// d = f B / Z of the near side of a spheroid that looks at the camera with its pole, and of a tilted disc.
TEST(Render, DisparitiesOfSimpleScenesAreExact) {
  SceneDescription scene;
  scene.width = 101;
  scene.height = 81;
  scene.focal_px = 200;
  scene.baseline_m = 0.1;
  scene.doffs_px = 3;
  scene.principal_px = cv::Vec2d(50, 40);
  Surface fruit;
  fruit.shape = Shape::kSpheroid;
  fruit.center = {0, 0, 1};
  fruit.v = {0, 0, 0.1};
  fruit.radius_m = 0.2;
  scene.surfaces = {fruit};
  const RenderedPair pair = render(scene);
  EXPECT_FLOAT_EQ(pair.left.disparity.at<float>(40, 50), 20 / 0.9 - 3);
  for (int x = 20; x <= 80; ++x) {  // (x z / r)^2 + ((z - 1) / 0.1)^2 = 1, x in units of the focal length
    const double t = (x - 50) / 200.0, a = t * t / 0.04 + 100, b = -100, c = 99;
    const double z = (-b - std::sqrt(b * b - a * c)) / a;
    if (b * b - a * c < 0) continue;
    EXPECT_NEAR(pair.left.disparity.at<float>(40, x), 20 / z - 3, 1e-5) << x;
  }
}

SceneDescription smallCameras(int width = 160) {
  return sceneFor(resized(namedRig("seed-003"), width, width * 9 / 16));
}

Orchard smallOrchard(std::uint64_t seed = 3) {
  OrchardOptions options;
  options.seed = seed;
  return orchard(smallCameras(), options);
}

std::vector<Solid> solidsOf(const SceneDescription& scene) {
  std::vector<Solid> solids;
  for (const Surface& surface : scene.surfaces) solids.emplace_back(surface, 0);
  return solids;
}

Hit bruteForce(const std::vector<Solid>& solids, const Vec3d& origin, const Vec3d& direction) {
  Hit hit;
  for (const Solid& solid : solids)
    if (const double depth = solid.depthAlong(origin, direction); depth < hit.depth) hit = {&solid, depth};
  return hit;
}

TEST(RayGrid, FindsWhatBruteForceFinds) {
  const std::vector<Solid> solids = solidsOf(smallOrchard().scene);
  const Vec3d origin(0.05, -0.02, 0.01);
  // Looking up to the right; rays may leave the range.
  const Vec3d z = unit({0.3, -0.2, 1}), x = unit(Vec3d(0, 1, 0).cross(z)), y = z.cross(x);
  const cv::Matx33d axes(x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]);
  const RayGrid grid(solids, origin, axes, {-0.3, -0.2, 0.7, 0.5}, {23, 17}, RayGrid::Beyond::kEdgeCells);
  RandomVectors random(3);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d direction = x * random.between(-0.5, 0.5) + y * random.between(-0.5, 0.5) + z;
    const Hit expected = bruteForce(solids, origin, direction), found = grid.firstHit(direction);
    EXPECT_EQ(found.solid, expected.solid) << i;
    EXPECT_EQ(found.depth, expected.depth) << i;
    if (!expected.solid || expected.solid->shape == Shape::kPlane) continue;
    ++hits;
    EXPECT_TRUE(grid.isBlocked(direction, expected.depth * 1.001)) << i;
    EXPECT_FALSE(grid.isBlocked(direction, expected.depth * 0.999)) << i;
  }
  EXPECT_GT(hits, 500);
}

// Disparity, surface and mask of both views, pixel by pixel, from the definitions.
TEST(Render, TruthIsWhatBruteForceSays) {
  const SceneDescription scene = smallOrchard().scene;
  const RenderedPair pair = render(scene);
  const std::vector<Solid> solids = solidsOf(scene);
  const double cx = (*scene.principal_px)[0], cy = (*scene.principal_px)[1];
  int occluded = 0;
  for (const bool right : {false, true}) {
    const RenderedView& view = right ? pair.right : pair.left;
    const Vec3d here(right ? scene.baseline_m : 0, 0, 0), there(right ? 0 : scene.baseline_m, 0, 0);
    for (int y = 0; y < scene.height; y += 3)
      for (int x = 0; x < scene.width; ++x) {
        const Vec3d direction((x - cx) / scene.focal_px, (y - cy) / scene.focal_px, 1);
        const Hit hit = bruteForce(solids, here, direction);
        const double d = scene.focal_px * scene.baseline_m / hit.depth;
        EXPECT_EQ(view.surface.at<int>(y, x), hit.solid - solids.data());
        EXPECT_FLOAT_EQ(view.disparity.at<float>(y, x), static_cast<float>(d));
        // The other camera looks straight at the point: does it get there?
        const Vec3d point = here + direction * hit.depth;
        const double other_x = cx + scene.focal_px * (point[0] - there[0]) / point[2];
        const Hit seen = bruteForce(solids, there, (point - there) / point[2]);
        const bool visible =
            other_x >= -0.5 && other_x < scene.width - 0.5 && seen.depth > hit.depth - 1e-7 * hit.depth;
        occluded += !visible;
        if (std::abs(other_x + 0.5) < 1e-6 || std::abs(other_x - scene.width + 0.5) < 1e-6) continue;
        EXPECT_EQ(view.mask.at<std::uint8_t>(y, x), visible ? 255 : 128) << right << ' ' << x << ' ' << y;
      }
  }
  EXPECT_GT(occluded, 500);
}

void expectSame(const cv::Mat& a, const cv::Mat& b, const std::string& what) {
  ASSERT_EQ(a.type(), b.type());
  for (int y = 0; y < a.rows; ++y)
    EXPECT_TRUE(std::equal(a.ptr(y), a.ptr(y) + a.cols * a.elemSize(), b.ptr(y))) << what << ", row " << y;
}

TEST(Render, BytesDoNotDependOnThreads) {
  SceneDescription scene = smallOrchard().scene;
  takeThroughLenses(resized(namedRig("seed-003"), scene.width, scene.height), scene);
  CameraEffects effects;
  effects.blur_px = 0.7;
  effects.shot_noise = 4;
  effects.read_noise = 1;
  const RenderedPair expected = render(scene, effects, 1);
  for (const int threads : {2, 3, 7}) {
    const RenderedPair pair = render(scene, effects, threads);
    for (const auto& [a, b] : {std::pair(pair.left, expected.left), std::pair(pair.right, expected.right)}) {
      expectSame(a.image, b.image, "image, threads " + std::to_string(threads));
      expectSame(a.disparity, b.disparity, "disparity, threads " + std::to_string(threads));
      expectSame(a.mask, b.mask, "mask, threads " + std::to_string(threads));
      expectSame(a.surface, b.surface, "surface, threads " + std::to_string(threads));
    }
  }
}

// A raw picture shows at the pixel where the lens puts a direction what the ideal one shows in that
// direction.
TEST(Render, LensesBendThePictureAndNotTheTruth) {
  const StereoRig rig = resized(namedRig("seed-003"), 320, 180);
  SceneDescription scene = sceneFor(rig);
  scene.surfaces.push_back({Shape::kPlane,
                            {0, 0, 2},
                            {1, 0, 0.2},
                            {0, 1, 0},
                            0,
                            {{0, 0, 0}, {255, 255, 255}, 0.3, Pattern::kMottle}});
  const RenderedPair ideal = render(scene);
  takeThroughLenses(rig, scene);
  const RenderedPair raw = render(scene);
  expectSame(raw.left.disparity, ideal.left.disparity, "disparity");
  double bent = 0, straight = 0;
  int count = 0;
  for (const bool right : {false, true}) {
    const cv::Mat &a = right ? raw.right.image : raw.left.image,
                  &b = right ? ideal.right.image : ideal.left.image;
    for (int y = 4; y < 176; y += 7)
      for (int x = 4; x < 316; x += 7) {
        const StereoCalibration c = rig.rectification->calibration;
        const cv::Vec2d p =
            (right ? rig.right : rig.left).pixelOf({(x - c.cx_px) / c.focal_px, (y - c.cy_px) / c.focal_px});
        const int x0 = static_cast<int>(std::floor(p[0])), y0 = static_cast<int>(std::floor(p[1]));
        const double s = p[0] - x0, t = p[1] - y0;
        const auto at = [&](int i, int j) { return 1.0 * a.at<cv::Vec3b>(y0 + j, x0 + i)[1]; };
        const double value =
            (at(0, 0) * (1 - s) + at(1, 0) * s) * (1 - t) + (at(0, 1) * (1 - s) + at(1, 1) * s) * t;
        bent += std::abs(value - b.at<cv::Vec3b>(y, x)[1]);
        straight += std::abs(a.at<cv::Vec3b>(y, x)[1] - b.at<cv::Vec3b>(y, x)[1]);
        ++count;
      }
  }
  EXPECT_LT(bent / count, 3.5);
  EXPECT_GT(straight, 2 * bent);
}

// Cameras that are turned see elsewhere what the ideal ones see; the rig says where.
TEST(Render, TurnedCamerasSeeThroughTheirRotation) {
  StereoRig rig = resized(namedRig("seed-003"), 160, 90);
  rig.rectification.reset();
  const double angle = 0.02;  // the right camera looks to the right
  rig.right_from_left_rotation = {std::cos(angle), 0, -std::sin(angle), 0, 1, 0,
                                  std::sin(angle), 0, std::cos(angle)};
  const Rectification rectification = rectificationOf(rig);
  SceneDescription scene = sceneFor(rig);
  takeThroughLenses(rig, scene);
  const Vec3d white(255, 255, 255), spot(0.03, -0.05, 1.5);
  scene.surfaces.push_back({Shape::kSphere, spot, {}, {}, 0.03, {white, white, 1}});
  const RenderedPair pair = render(scene);
  for (const bool right : {false, true}) {
    const CameraModel& camera = right ? rig.right : rig.left;
    const cv::Matx33d turn = right ? rectification.right_rotation : rectification.left_rotation;
    const Vec3d p = turn.t() * (spot - Vec3d(right ? scene.baseline_m : 0, 0, 0));
    const cv::Vec2d expected = camera.pixelOf({p[0] / p[2], p[1] / p[2]});
    const cv::Mat lit = (right ? pair.right : pair.left).image.reshape(1) > 0;
    double x = 0, y = 0, count = 0;
    for (int row = 0; row < lit.rows; ++row)
      for (int column = 0; column < lit.cols; ++column)
        if (lit.at<std::uint8_t>(row, column) > 0) x += column / 3, y += row, ++count;
    ASSERT_GT(count, 20);
    EXPECT_NEAR(x / count, expected[0], 0.3) << right;
    EXPECT_NEAR(y / count, expected[1], 0.3) << right;
  }
}

TEST(Render, RightViewShiftsByWholeRows) {
  SceneDescription scene = smallOrchard().scene;
  const cv::Mat straight = render(scene).right.image;
  shiftRightView(3, scene);
  const RenderedPair pair = render(scene);
  for (int y = 0; y + 3 < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      EXPECT_LE(
          cv::norm(pair.right.image.at<cv::Vec3b>(y, x), straight.at<cv::Vec3b>(y + 3, x), cv::NORM_INF), 1);
  expectSame(pair.left.image, render(smallOrchard().scene).left.image, "left");
}

// An evenly gray wall.
RenderedPair grayWall(double value, const CameraEffects& effects, int bits = 8, int channels = 1) {
  SceneDescription scene;
  scene.width = 256;
  scene.height = 200;
  scene.focal_px = 200;
  scene.baseline_m = 0.1;
  scene.channels = channels;
  scene.bits = bits;
  const Vec3d color(value, value, value);
  scene.surfaces.push_back({Shape::kPlane, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0, {color, color, 0.1}});
  return render(scene, effects);
}

struct Statistics {
  double mean, deviation;
};
Statistics statisticsOf(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(CameraEffects, NoiseHasItsDeviationAtAnyBrightness) {
  CameraEffects effects;
  effects.read_noise = 2;
  effects.shot_noise = 8;
  for (const double value : {40.0, 100.0, 200.0}) {
    const RenderedPair pair = grayWall(value, effects);
    const double expected = std::sqrt(4 + 64 * value / 255 + 1.0 / 12);  // and rounding
    for (const cv::Mat& image : {pair.left.image, pair.right.image}) {
      EXPECT_NEAR(statisticsOf(image).mean, value, 0.1) << value;
      EXPECT_NEAR(statisticsOf(image).deviation, expected, 0.02 * expected) << value;
    }
    // Views, neighbours and seeds have nothing in common: differences have twice the variance.
    cv::Mat difference;
    cv::subtract(pair.left.image, pair.right.image, difference, {}, CV_32F);
    EXPECT_NEAR(statisticsOf(difference).deviation, std::sqrt(2) * expected, 0.04 * expected);
    for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1)}) {
      const cv::Rect most(0, 0, pair.left.image.cols - 1, pair.left.image.rows - 1);
      cv::subtract(pair.left.image(most), pair.left.image(most + step), difference, {}, CV_32F);
      EXPECT_NEAR(statisticsOf(difference).deviation, std::sqrt(2) * expected, 0.04 * expected);
    }
    effects.noise_seed += 1;
    cv::subtract(pair.left.image, grayWall(value, effects).left.image, difference, {}, CV_32F);
    EXPECT_NEAR(statisticsOf(difference).deviation, std::sqrt(2) * expected, 0.04 * expected);
  }
}

TEST(CameraEffects, ExposureGainVignettingAndBits) {
  CameraEffects effects;
  effects.exposure = 1.5;
  effects.right_gain = 0.5;
  effects.vignetting = 0.4;
  const RenderedPair pair = grayWall(100, effects, 16);
  ASSERT_EQ(pair.left.image.type(), CV_16UC1);
  EXPECT_NEAR(pair.left.image.at<std::uint16_t>(100, 128), 150 * 257, 10);
  EXPECT_NEAR(pair.right.image.at<std::uint16_t>(100, 128), 75 * 257, 10);
  for (const cv::Point corner : {cv::Point(0, 0), cv::Point(255, 199), cv::Point(255, 0)})
    EXPECT_NEAR(pair.left.image.at<std::uint16_t>(corner), 0.6 * 150 * 257, 1);
  effects = {};
  effects.exposure = 100;
  EXPECT_EQ(statisticsOf(grayWall(100, effects).left.image).mean, 255);
}

// A white disc of one pixel's width becomes the Gaussian: the sum stays, and the spread is as asked for.
TEST(CameraEffects, BlurIsAGaussian) {
  cv::Mat light(41, 41, CV_64FC3, cv::Scalar::all(0));
  light.at<Vec3d>(20, 20) = Vec3d::all(255);
  CameraEffects effects;
  effects.blur_px = 1.7;
  const cv::Mat image = develop(light, effects, View::kLeft, 1, 16, 2);
  double sum = 0, spread = 0;
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) {
      sum += image.at<std::uint16_t>(y, x);
      spread += image.at<std::uint16_t>(y, x) * (x - 20.0) * (x - 20.0);
    }
  EXPECT_NEAR(sum, 65535, 150);  // rounding
  EXPECT_NEAR(std::sqrt(spread / sum), 1.7, 0.03);
}

// Far away, fine detail fades to its mean instead of flickering; near by it stays.
TEST(Paint, LeavesOutWhatPixelsCannotShow) {
  Surface wall;
  wall.shape = Shape::kParallelogram;
  wall.u = {1, 0, 0};
  wall.v = {0, 1, 0};
  for (const Pattern pattern : {Pattern::kMottle, Pattern::kFoliage}) {
    wall.paint = {{0, 0, 0}, {200, 200, 200}, 0.008, pattern};
    const Solid solid(wall, 5);
    const auto spread = [&](double pixel_m) {
      RandomVectors random(1);
      cv::Mat values(1, 500, CV_64F);
      for (int i = 0; i < values.cols; ++i) {
        const Vec3d p{random.between(-1, 1), random.between(0.3, 1), 0};
        values.at<double>(i) = paintAt(solid, p, pixel_m)[1];
      }
      return statisticsOf(values).deviation;
    };
    EXPECT_GT(spread(0.0001), 20);
    EXPECT_LT(spread(0.003), 0.9 * spread(0.0001));
    EXPECT_LT(spread(0.02), 1e-9);
  }
}

TEST(Paint, LettersAreReadable) {
  EXPECT_TRUE(isInText("I", 0.5, 0.5));
  EXPECT_FALSE(isInText("O", 0.5, 0.5));
  EXPECT_TRUE(isInText("LO", 0.02, 0.2));   // the L's stem
  EXPECT_FALSE(isInText("LO", 0.3, 0.2));   // beside it
  EXPECT_TRUE(isInText("LO", 0.3, 0.98));   // its foot
  EXPECT_FALSE(isInText("A A", 0.5, 0.5));  // a gap
  EXPECT_FALSE(isInText("", 0.5, 0.5));
  EXPECT_FALSE(isInText("H", 1.0, 0.5));
}

TEST(Angle, AgreesWithTheLibrary) {
  for (double degrees = -360; degrees <= 360; degrees += 3.7) {
    const double x = degrees * CV_PI / 180;
    EXPECT_NEAR(cosineAndSine(degrees)[0], std::cos(x), 1e-14);
    EXPECT_NEAR(cosineAndSine(degrees)[1], std::sin(x), 1e-14);
  }
}

TEST(Rigs, RectifyToTheTruthsGeometry) {
  for (const std::string& name : rigNames()) {
    const StereoRig rig = namedRig(name);
    EXPECT_NO_THROW(rig.validate()) << name;
    const StereoCalibration c = rectificationOf(rig).calibration;
    const SceneDescription scene = sceneFor(rig);
    EXPECT_EQ(scene.focal_px, c.focal_px);
    EXPECT_EQ(scene.baseline_m, rig.baselineM());
    EXPECT_EQ((*scene.principal_px)[0], c.cx_px);
    const StereoRig half = resized(rig, c.width / 2, c.height / 2);
    EXPECT_NEAR(rectificationOf(half).calibration.focal_px, c.focal_px / 2, 1e-9);
    EXPECT_EQ(half.left.distortion, rig.left.distortion);
  }
  EXPECT_DOUBLE_EQ(namedRig("seed-003").baselineM(), 2 * namedRig("seed-003-b60").baselineM());
  EXPECT_THROW(namedRig("seed-004"), std::invalid_argument);
}

TEST(CameraEffects, AreRefusedOutsideOfTheirRanges) {
  const auto refused = [](auto change) {
    CameraEffects effects;
    EXPECT_NO_THROW(effects.validate());
    change(effects);
    EXPECT_THROW(effects.validate(), std::invalid_argument);
  };
  refused([](CameraEffects& e) { e.blur_px = 11; });
  refused([](CameraEffects& e) { e.vignetting = -0.1; });
  refused([](CameraEffects& e) { e.exposure = 0; });
  refused([](CameraEffects& e) { e.right_gain = std::nan(""); });
  refused([](CameraEffects& e) { e.shot_noise = -1; });
  refused([](CameraEffects& e) { e.read_noise = 1000; });
}

TEST(Render, PicturesLieUprightOnTheirSurfaces) {
  Surface sheet{Shape::kParallelogram, {0, 0, 2}, {0.5, 0, 0}, {0, 0.25, 0}, 0, {}};
  sheet.paint.pattern = Pattern::kPicture;
  sheet.paint.picture = cv::Mat(64, 128, CV_8UC3, cv::Scalar(10, 20, 30));
  sheet.paint.picture(cv::Rect(64, 0, 64, 32)).setTo(cv::Scalar(200, 100, 50));  // above, at the right
  for (int x = 0; x < 32; ++x)  // stripes that no camera this far away resolves
    for (int y = 32; y < 64; ++y)
      sheet.paint.picture.at<cv::Vec3b>(y, x) = x % 2 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(200, 200, 200);
  SceneDescription scene;
  scene.width = 32;
  scene.height = 16;
  scene.focal_px = 64;
  scene.baseline_m = 0.01;
  scene.num_disparities = 4;
  scene.surfaces = {sheet};
  const cv::Mat image = render(scene).left.image;
  EXPECT_EQ(image.at<cv::Vec3b>(3, 5), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(image.at<cv::Vec3b>(3, 26), cv::Vec3b(200, 100, 50));
  EXPECT_EQ(image.at<cv::Vec3b>(12, 26), cv::Vec3b(10, 20, 30));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at<cv::Vec3b>(12, 3)[k], 100, 2);
  scene.surfaces[0].shape = Shape::kEllipse;
  EXPECT_THROW(render(scene), std::invalid_argument);
  scene.surfaces[0].shape = Shape::kParallelogram;
  scene.surfaces[0].paint.picture = cv::Mat();
  EXPECT_THROW(render(scene), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
