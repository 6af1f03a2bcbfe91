#include "datasets/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "datasets/named_scenes.h"
#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/orchard.h"
#include "datasets/rendering/storefront.h"

namespace pomona {
namespace {

SceneDescription emptyScene(int width, int height) {
  SceneDescription scene;
  scene.width = width;
  scene.height = height;
  scene.focal_px = 100;
  scene.baseline_m = 0.1;
  return scene;
}

const Paint kPaint{{20, 40, 60}, {200, 220, 240}, 0.2};

double fraction(int part, int whole) {
  return static_cast<double>(part) / std::max(1, whole);
}

std::uint64_t fnv1a(std::uint64_t hash, const cv::Mat& map) {
  for (int y = 0; y < map.rows; ++y)
    for (std::size_t i = 0; i < map.cols * map.elemSize(); ++i)
      hash = (hash ^ map.ptr(y)[i]) * 0x100000001b3u;
  return hash;
}

std::uint64_t fnv1a(const RenderedPair& pair) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const RenderedView* view : {&pair.left, &pair.right})
    for (const cv::Mat& map : {view->image, view->disparity, view->mask}) hash = fnv1a(hash, map);
  return hash;
}

TEST(Render, FrontoParallelPlaneHasOneDisparityAndTheViewsAreShiftedCopies) {
  SceneDescription scene = emptyScene(61, 17);
  scene.surfaces.push_back({Shape::kPlane, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0, kPaint});
  const RenderedPair pair = render(scene);  // d = 100 * 0.1 / 2 = 5
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 61; ++x) {
      EXPECT_FLOAT_EQ(pair.left.disparity.at<float>(y, x), 5);
      EXPECT_FLOAT_EQ(pair.right.disparity.at<float>(y, x), 5);
      EXPECT_EQ(pair.left.mask.at<std::uint8_t>(y, x), x < 5 ? 128 : 255) << x;
      EXPECT_EQ(pair.right.mask.at<std::uint8_t>(y, x), x >= 56 ? 128 : 255) << x;
      if (x < 5) continue;
      const double difference = cv::norm(pair.left.image.at<cv::Vec3b>(y, x),
                                         pair.right.image.at<cv::Vec3b>(y, x - 5), cv::NORM_INF);
      EXPECT_LE(difference, 1) << x << ' ' << y;  // equal up to rounding
    }
  cv::Scalar mean, deviation;
  cv::meanStdDev(pair.left.image, mean, deviation);
  EXPECT_GT(deviation[0], 20) << "there must be texture to match";
}

// Sphere of radius r at distance D on the axis: the centre ray meets it at D - r, and it fills the pixels
// within f r / sqrt(D^2 - r^2) of the centre.
TEST(Render, SphereHasItsDepthAndOutline) {
  SceneDescription scene = emptyScene(81, 81);
  scene.surfaces.push_back({Shape::kSphere, {0, 0, 2}, {}, {}, 0.5, kPaint});
  const RenderedPair pair = render(scene);
  EXPECT_FLOAT_EQ(pair.left.disparity.at<float>(40, 40), 10 / 1.5f);
  const double outline_px = 100 * 0.5 / std::sqrt(4 - 0.25);
  for (int y = 0; y < 81; ++y)
    for (int x = 0; x < 81; ++x) {
      const bool inside = std::hypot(x - 40, y - 40) < outline_px;
      EXPECT_EQ(std::isnan(pair.left.disparity.at<float>(y, x)), !inside) << x << ' ' << y;
      EXPECT_EQ(pair.left.mask.at<std::uint8_t>(y, x) == 0, !inside) << x << ' ' << y;
    }
}

TEST(Render, PanelsAndEllipsesEndWhereTheyShould) {
  for (const Shape shape : {Shape::kParallelogram, Shape::kEllipse}) {
    SceneDescription scene = emptyScene(81, 61);
    scene.surfaces.push_back({shape, {0, 0, 1}, {0.255, 0, 0}, {0, 0.155, 0}, 0, kPaint});
    const RenderedPair pair = render(scene);
    for (int y = 0; y < 61; ++y)
      for (int x = 0; x < 81; ++x) {
        const double a = (x - 40) / 25.5, b = (y - 30) / 15.5;
        const bool inside =
            shape == Shape::kEllipse ? a * a + b * b <= 1 : std::abs(a) <= 1 && std::abs(b) <= 1;
        EXPECT_EQ(std::isnan(pair.left.disparity.at<float>(y, x)), !inside) << x << ' ' << y;
      }
  }
}

// A near panel before a far plane: to its left, in the left view, lies the strip of background that the right
// camera cannot see, as wide as the disparity step; the right view has its strip on the other side.
TEST(Render, OcclusionIsTheStripBesideTheNearObject) {
  SceneDescription scene = emptyScene(101, 9);
  scene.surfaces.push_back({Shape::kPlane, {0, 0, 5}, {1, 0, 0}, {0, 1, 0}, 0, kPaint});  // d = 2
  scene.surfaces.push_back(
      {Shape::kParallelogram, {0, 0, 1}, {0.105, 0, 0}, {0, 1, 0}, 0, kPaint});  // d = 10
  const RenderedPair pair = render(scene);
  // The panel covers x = 40..60 in the left view and 30..50 in the right.
  for (int x = 0; x < 101; ++x) {
    const bool left_hidden = x < 2 || (x >= 32 && x < 40);
    const bool right_hidden = x > 98 || (x > 50 && x <= 58);
    EXPECT_EQ(pair.left.mask.at<std::uint8_t>(4, x), left_hidden ? 128 : 255) << x;
    EXPECT_EQ(pair.right.mask.at<std::uint8_t>(4, x), right_hidden ? 128 : 255) << x;
    EXPECT_FLOAT_EQ(pair.left.disparity.at<float>(4, x), x >= 40 && x <= 60 ? 10 : 2) << x;
    EXPECT_FLOAT_EQ(pair.right.disparity.at<float>(4, x), x >= 30 && x <= 50 ? 10 : 2) << x;
  }
}

// Surfaces out of sight, behind the cameras, around them, and seen edge-on or at the horizon.
TEST(Render, ExtremePlacesAreHarmless) {
  SceneDescription scene = emptyScene(33, 31);
  scene.surfaces.push_back({Shape::kSphere, {0, 1e6, 2}, {}, {}, 1, kPaint});
  scene.surfaces.push_back({Shape::kSphere, {0, 0, -3}, {}, {}, 1, kPaint});
  scene.surfaces.push_back({Shape::kSphere, {0, -1e-3, 1.1e-3}, {}, {}, 1e-3, kPaint});
  scene.surfaces.push_back({Shape::kSphere, {0, 0, 0}, {}, {}, 1, kPaint});
  scene.surfaces.push_back({Shape::kPlane, {0, 0, 2}, {0, 1, 0}, {0, 0, 1}, 0, kPaint});
  scene.surfaces.push_back({Shape::kPlane, {0, 1, 0}, {1, 0, 0}, {0, 1e-12, 1}, 0, kPaint});
  const RenderedPair pair = render(scene);
  EXPECT_TRUE(std::isnan(pair.left.disparity.at<float>(15, 0)));  // the horizon
  EXPECT_FLOAT_EQ(pair.left.disparity.at<float>(30, 0),
                  10 * 15 / 100.0f);  // the ground, 1 m below: Z = 100 / 15
}

// The named scenes, and those that need a rig.
std::vector<std::string> allScenes() {
  std::vector<std::string> names = sceneNames();
  names.insert(names.end(), {"orchard", "storefront"});
  return names;
}
SceneDescription anyScene(const std::string& name, int width, int height) {
  const SceneDescription cameras = sceneFor(resized(namedRig("seed-003"), width, height));
  if (name == "orchard") return orchard(cameras, {.seed = 7, .nearest_m = 1, .farthest_m = 1.2}).scene;
  if (name == "storefront") return storefront(cameras, {.seed = 7}).scene;
  return namedScene(name, 7, width, height, width / 10);
}

// Large enough for thin things to be seen; rendered once for the tests that compare the views.
const RenderedPair& renderedPair(const std::string& name) {
  static std::map<std::string, RenderedPair> pairs;
  if (!pairs.contains(name)) pairs[name] = render(anyScene(name, 320, 240));
  return pairs[name];
}

struct Lookup {
  bool inside;
  int x0;
  float t;
};
Lookup lookUp(double x, int width) {
  const int x0 = static_cast<int>(std::floor(x));
  return {x0 >= 0 && x0 + 1 < width, x0, static_cast<float>(x - x0)};
}

// Visible pixels meet a pixel of the other view with their own disparity, and hidden ones meet something
// nearer or leave the image. Interpolated at whole pixels, this may fail beside depth edges only.
void checkVisibility(const RenderedView& here, const RenderedView& there, int direction,
                     double least_agreement, const std::string& label) {
  int visible = 0, agree = 0, hidden = 0, explained = 0;
  for (int y = 0; y < here.disparity.rows; ++y)
    for (int x = 0; x < here.disparity.cols; ++x) {
      const float d = here.disparity.at<float>(y, x);
      const Lookup at = lookUp(x + direction * double{d}, here.disparity.cols);
      if (here.mask.at<std::uint8_t>(y, x) == 255) {
        if (!at.inside) continue;
        const float a = there.disparity.at<float>(y, at.x0), b = there.disparity.at<float>(y, at.x0 + 1);
        ++visible;
        agree += std::abs(a + at.t * (b - a) - d) < 0.05f;
      } else {
        ++hidden;
        explained += !at.inside || std::max(there.disparity.at<float>(y, at.x0),
                                            there.disparity.at<float>(y, at.x0 + 1)) > d;
      }
    }
  EXPECT_GT(visible, here.disparity.cols * here.disparity.rows / 2) << label;
  EXPECT_GT(fraction(agree, visible), least_agreement) << label;
  EXPECT_GT(hidden, 0) << label;
  EXPECT_GT(fraction(explained, hidden), 0.98) << label;
}

TEST(Scenes, DisparitiesAndMasksOfBothViewsAgree) {
  for (const std::string& name : allScenes()) {
    const RenderedPair& pair = renderedPair(name);
    const double least_agreement = name == "orchard" ? 0.8 : 0.93;  // most of its leaves are edge
    checkVisibility(pair.left, pair.right, -1, least_agreement, name + " left");
    checkVisibility(pair.right, pair.left, 1, least_agreement, name + " right");
  }
}

// Mean difference between the left image and the right one fetched at x - d - shift, over visible pixels.
double warpDifference(const RenderedPair& pair, double shift) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < pair.left.image.rows; ++y)
    for (int x = 0; x < pair.left.image.cols; ++x) {
      if (pair.left.mask.at<std::uint8_t>(y, x) != 255) continue;
      const Lookup at = lookUp(x - double{pair.left.disparity.at<float>(y, x)} - shift, pair.left.image.cols);
      if (!at.inside) continue;
      const auto a = pair.right.image.at<cv::Vec3b>(y, at.x0),
                 b = pair.right.image.at<cv::Vec3b>(y, at.x0 + 1);
      const auto left = pair.left.image.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) sum += std::abs(a[c] + at.t * (b[c] - a[c]) - left[c]);
      count += 3;
    }
  return sum / count;
}

TEST(Scenes, WarpingByTheTrueDisparityExplainsTheOtherView) {
  for (const std::string& name : allScenes()) {
    const RenderedPair& pair = renderedPair(name);
    const double right = warpDifference(pair, 0);
    EXPECT_LT(right, 5) << name;
    for (const double shift : {-1.0, 1.0})
      EXPECT_GT(warpDifference(pair, shift), 1.8 * right) << name << ' ' << shift;
  }
}

TEST(NamedScenes, FillTheViewWithinTheirDisparityRangeForManySeeds) {
  for (const std::string& name : sceneNames())
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const RenderedPair pair = render(namedScene(name, seed, 64, 48, 16));
      for (const RenderedView* view : {&pair.left, &pair.right}) {
        double low = 0, high = 0;
        cv::minMaxLoc(view->disparity, &low, &high);
        EXPECT_EQ(cv::countNonZero(view->disparity == view->disparity), 64 * 48) << name << ' ' << seed;
        EXPECT_GT(low, 0) << name << ' ' << seed;
        EXPECT_LT(high, 16) << name << ' ' << seed;
      }
    }
}

// The same pixels on every machine and compiler: the tests of other stages build on these scenes.
TEST(NamedScenes, AreTheSameEverywhere) {
  const struct {
    const char* name;
    std::uint64_t hash;
  } golden[] = {{"boxes", 0xc26a1677743b1327u},
                {"trees", 0x3ee0c33578ea8bc2u},
                {"planes", 0x416db12692efefb1u},
                {"spheres", 0xe394bc5213c80250u}};
  for (const auto& scene : golden)
    EXPECT_EQ(fnv1a(render(namedScene(scene.name, 5, 96, 72, 16))), scene.hash) << scene.name;
  for (const auto& [name, hash] :
       {std::pair("orchard", 0xfcd21280e8b9f5cu), {"storefront", 0xdefb6c480c9f63c3u}})
    EXPECT_EQ(fnv1a(render(anyScene(name, 96, 72))), hash) << name;
}

TEST(NamedScenes, SeedsDiffer) {
  EXPECT_NE(fnv1a(render(namedScene("planes", 1, 32, 32, 8))),
            fnv1a(render(namedScene("planes", 2, 32, 32, 8))));
}

TEST(Render, GrayAndSixteenBitViewsShowTheSameScene) {
  SceneDescription scene = namedScene("spheres", 1, 48, 32, 8);
  const cv::Mat color = render(scene).left.image;
  scene.bits = 16;
  const cv::Mat deep = render(scene).left.image;
  scene.channels = 1;
  const cv::Mat gray = render(scene).left.image;
  ASSERT_EQ(deep.type(), CV_16UC3);
  ASSERT_EQ(gray.type(), CV_16UC1);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x) {
      const auto c = color.at<cv::Vec3b>(y, x);
      const auto d = deep.at<cv::Vec3w>(y, x);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(d[i] / 257.0, c[i], 0.51);
      EXPECT_NEAR(gray.at<std::uint16_t>(y, x), 0.114 * d[0] + 0.587 * d[1] + 0.299 * d[2], 1.01);
    }
}

TEST(Render, RefusesDescriptionsThatCannotBeRendered) {
  const auto refused = [](auto change) {
    SceneDescription scene = emptyScene(8, 8);
    scene.surfaces.push_back({Shape::kPlane, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0, kPaint});
    EXPECT_NO_THROW(render(scene));
    change(scene);
    EXPECT_THROW(render(scene), std::invalid_argument);
  };
  refused([](SceneDescription& s) { s.width = 0; });
  refused([](SceneDescription& s) { s.height = 100000; });
  refused([](SceneDescription& s) { s.channels = 2; });
  refused([](SceneDescription& s) { s.bits = 12; });
  refused([](SceneDescription& s) { s.focal_px = 0; });
  refused([](SceneDescription& s) { s.baseline_m = std::nan(""); });
  refused([](SceneDescription& s) { s.surfaces[0].v = {2, 0, 0}; });
  refused([](SceneDescription& s) { s.surfaces[0].shape = Shape::kSphere; });
  refused([](SceneDescription& s) { s.surfaces[0].paint.cell_m = 0; });
  refused([](SceneDescription& s) { s.surfaces[0].center[0] = HUGE_VAL; });
  EXPECT_THROW(namedScene("forest", 1, 64, 48), std::invalid_argument);
  EXPECT_THROW(namedScene("boxes", 1, 8, 48), std::invalid_argument);
  EXPECT_THROW(namedScene("boxes", 1, 64, 9000), std::invalid_argument);
  EXPECT_THROW(namedScene("boxes", 1, 64, 48, 33), std::invalid_argument);
  EXPECT_THROW(namedScene("boxes", 1, 64, 48, -1), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
