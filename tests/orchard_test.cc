// Orchards and shop fronts: what their lists say is what their pictures show.
#include "datasets/rendering/orchard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/sightings.h"
#include "datasets/rendering/storefront.h"

namespace pomona {
namespace {

using cv::Vec3d;

SceneDescription cameras(const char* rig, int width, int height) {
  return sceneFor(resized(namedRig(rig), width, height));
}

std::vector<int> surfacesOf(const std::vector<Fruit>& fruits) {
  std::vector<int> surfaces;
  for (const Fruit& fruit : fruits) surfaces.push_back(fruit.surface);
  return surfaces;
}

struct Band {
  double nearest_m, farthest_m;
};
constexpr Band kBands[] = {{0.6, 0.75}, {1.0, 1.2}, {1.6, 1.9}};

Orchard orchardIn(const Band& band, std::uint64_t seed, const SceneDescription& cameras) {
  OrchardOptions options;
  options.seed = seed;
  options.nearest_m = band.nearest_m;
  options.farthest_m = band.farthest_m;
  return orchard(cameras, options);
}

TEST(Orchard, HangsSeveralVisibleFruitsInItsBand) {
  for (const Band& band : kBands) {
    int fruits = 0, well_visible = 0, touched = 0, partly_hidden = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Orchard o = orchardIn(band, seed, cameras("seed-003", 192, 108));
      EXPECT_GE(o.fruits.size(), 6u);
      for (const Sighting& s : sightings(o.scene, render(o.scene), surfacesOf(o.fruits))) {
        EXPECT_GE(s.visible_share, 0);
        EXPECT_LE(s.visible_share, 1);
        ++fruits;
        well_visible += s.visible_share >= 0.3;
        touched += s.visible_share > 0.05 && s.visible_share < 0.9;
        partly_hidden += s.seen_by_both < 0.99;
      }
      for (const Fruit& fruit : o.fruits) {
        EXPECT_GE(fruit.center_m[2], band.nearest_m);
        EXPECT_LE(fruit.center_m[2], band.farthest_m);
      }
    }
    EXPECT_GT(well_visible, 0.75 * fruits) << band.nearest_m;
    EXPECT_GT(touched, 0.3 * fruits) << "leaves cover some, " << band.nearest_m;
    EXPECT_GT(partly_hidden, 0.3 * fruits) << band.nearest_m;
  }
}

TEST(Orchard, FruitsOfAClusterTouchAndNoneOverlap) {
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Orchard o = orchardIn(kBands[seed % 3], seed, cameras("seed-003", 320, 180));
    for (std::size_t i = 0; i < o.fruits.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Fruit &a = o.fruits[i], &b = o.fruits[j];
        const double gap = cv::norm(a.center_m - b.center_m) - a.radius_m - b.radius_m;
        EXPECT_GT(gap, -1e-4);
        if (a.cluster != b.cluster) continue;
        ++pairs;
        EXPECT_LT(gap, 1e-9);
      }
  }
  EXPECT_GE(pairs, 12);
}

// Without all the rest, the picture of a single fruit gives its outline, its distance and its depth.
TEST(Orchard, ListAgreesWithThePictureOfEachFruitAlone) {
  const Orchard o = orchardIn(kBands[0], 4, cameras("seed-003", 320, 180));
  const RenderedPair whole = render(o.scene);
  const std::vector<Sighting> seen = sightings(o.scene, whole, surfacesOf(o.fruits));
  const cv::Mat labels = labelsOf(o.scene, whole, surfacesOf(o.fruits));
  for (std::size_t i = 0; i < o.fruits.size(); ++i) {
    const Fruit& fruit = o.fruits[i];
    SceneDescription alone = o.scene;
    alone.surfaces = {o.scene.surfaces[fruit.surface]};
    const RenderedPair pair = render(alone);
    const cv::Mat silhouette = pair.left.mask > 0;
    const cv::Rect image(0, 0, 320, 180);
    ASSERT_EQ(seen[i].box_px & image, seen[i].box_px) << "the test needs fruits inside of the image";
    EXPECT_EQ(cv::boundingRect(silhouette), seen[i].box_px) << i;
    const int outline = cv::countNonZero(silhouette),
              visible = cv::countNonZero(labels == static_cast<int>(i + 1));
    EXPECT_EQ(visible, seen[i].visible_px);
    EXPECT_DOUBLE_EQ(seen[i].visible_share, 1.0 * visible / outline);
    // Where the fruit is labelled, its disparity is its own.
    int both = 0;
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 320; ++x) {
        if (labels.at<std::uint16_t>(y, x) != i + 1) continue;
        EXPECT_EQ(whole.left.disparity.at<float>(y, x), pair.left.disparity.at<float>(y, x));
        both += whole.left.mask.at<std::uint8_t>(y, x) == 255;
      }
    EXPECT_DOUBLE_EQ(seen[i].seen_by_both, 1.0 * both / std::max(1, visible));
    // The ray to the centre enters between the smallest and the largest radius before it.
    EXPECT_DOUBLE_EQ(fruit.distance_m, cv::norm(fruit.center_m));
    EXPECT_GE(fruit.distance_m - fruit.near_distance_m, fruit.half_height_m - 1e-12);
    EXPECT_LE(fruit.distance_m - fruit.near_distance_m, fruit.radius_m + 1e-12);
    double largest = 0;
    cv::minMaxLoc(pair.left.disparity, nullptr, &largest, nullptr, nullptr, silhouette);
    const double nearest_z = o.scene.focal_px * o.scene.baseline_m / largest;
    EXPECT_NEAR(nearest_z, fruit.center_m[2] - fruit.radius_m, 0.006);
    if (visible == outline) {
      EXPECT_NEAR(seen[i].nearest_z_m, nearest_z, 1e-9);
    }
  }
}

TEST(Orchard, OutlineReachesBeyondTheImage) {
  Orchard o = orchardIn(kBands[0], 1, cameras("seed-003", 320, 180));
  Surface fruit = o.scene.surfaces[o.fruits[0].surface];
  const int inside = outlineOf(o.scene, o.fruits[0].surface).pixels;
  fruit.center = {-0.3634, 0, 0.6};  // its middle lies at the image's left edge
  o.scene.surfaces = {fruit};
  const Outline outline = outlineOf(o.scene, 0);
  EXPECT_LT(outline.box_px.x, 0);
  EXPECT_GT(outline.pixels, inside / 2);
  const Sighting s = sightings(o.scene, render(o.scene), {0}).at(0);
  EXPECT_NEAR(s.visible_share, 0.5, 0.1);
}

TEST(Orchard, StaysBelowItsDisparitiesWithEveryRig) {
  for (const std::string& rig : rigNames())
    for (const Band& band : kBands) {
      const Orchard o = orchardIn(band, 2, cameras(rig.c_str(), 96, 60));
      const RenderedPair pair = render(o.scene);
      for (const RenderedView* view : {&pair.left, &pair.right}) {
        double low = 0, high = 0;
        cv::minMaxLoc(view->disparity, &low, &high);
        EXPECT_GT(low, 0) << rig;
        EXPECT_LT(high, o.scene.num_disparities) << rig;
        EXPECT_EQ(cv::countNonZero(view->disparity == view->disparity), 96 * 60)
            << "every ray meets something";
      }
    }
}

TEST(Orchard, SeedsAndOptionsDecide) {
  const SceneDescription c = cameras("seed-003", 160, 90);
  const auto center = [&](std::uint64_t seed) { return orchardIn(kBands[0], seed, c).fruits[0].center_m; };
  EXPECT_EQ(center(1), center(1));
  EXPECT_NE(center(1), center(2));
  OrchardOptions options;
  options.fruits = 3;
  EXPECT_EQ(orchard(c, options).fruits.size(), 3u);
  options.fruits = 201;
  EXPECT_THROW(orchard(c, options), std::invalid_argument);
  options = {};
  options.nearest_m = 0.1;
  EXPECT_THROW(orchard(c, options), std::invalid_argument);
  options.nearest_m = 2;
  EXPECT_THROW(orchard(c, options), std::invalid_argument) << "nearest beyond farthest";
}

TEST(Storefront, SignsLieOnTheirWallsAtTheAskedDistanceAndYaw) {
  for (const double yaw : {-45.0, -20.0, 0.0, 45.0}) {
    StorefrontOptions options;
    options.walls = 1;
    options.nearest_m = options.farthest_m = 3;
    options.least_yaw_deg = options.greatest_yaw_deg = yaw;
    const Storefront street = storefront(cameras("seed-003", 320, 180), options);
    const RenderedPair pair = render(street.scene);
    ASSERT_EQ(street.signs.size(), 3u);
    int pixels = 0;
    for (const Sign& sign : street.signs) {
      EXPECT_EQ(sign.yaw_deg, yaw);
      const Vec3d normal = sign.u_m.cross(sign.v_m);
      EXPECT_NEAR(std::atan2(sign.u_m[2], sign.u_m[0]) * 180 / CV_PI, yaw, 1e-9);
      // The wall's middle is 3 m away; the sign is 3.5 cm before the wall.
      EXPECT_NEAR(std::abs((sign.center_m - Vec3d(0, 0, 3)).dot(normal)) / cv::norm(normal), 0.035, 1e-9);
      for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) {
          if (pair.left.surface.at<int>(y, x) != sign.surface) continue;
          ++pixels;
          const StereoCalibration& c = pair.calibration;
          const Vec3d ray((x - c.cx_px) / c.focal_px, (y - c.cy_px) / c.focal_px, 1);
          const double z = sign.center_m.dot(normal) / ray.dot(normal);
          EXPECT_NEAR(pair.left.disparity.at<float>(y, x), c.focal_px * c.baseline_m / z, 1e-5);
        }
    }
    EXPECT_GT(pixels, 1500) << yaw;
  }
}

TEST(Storefront, WallsKeepToTheirBands) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    StorefrontOptions options;
    options.seed = seed;
    options.walls = 4;
    const Storefront street = storefront(cameras("seed-003", 320, 180), options);
    std::map<int, double> yaw_of_wall;
    std::set<std::string> texts;
    for (const Sign& sign : street.signs) {
      yaw_of_wall[sign.wall] = sign.yaw_deg;
      if (sign.text != "OPEN") texts.insert(sign.text);
    }
    EXPECT_EQ(yaw_of_wall.size(), 4u);
    EXPECT_EQ(texts.size(), 8u) << "no name twice";
    for (const auto& [wall, yaw] : yaw_of_wall) EXPECT_LE(std::abs(yaw), 45);
  }
}

TEST(Storefront, OptionsAreRefused) {
  const auto refused = [](auto change) {
    StorefrontOptions options;
    change(options);
    EXPECT_THROW(storefront(cameras("seed-003", 160, 90), options), std::invalid_argument);
  };
  refused([](StorefrontOptions& o) { o.walls = 0; });
  refused([](StorefrontOptions& o) { o.nearest_m = 0.1; });
  refused([](StorefrontOptions& o) { o.farthest_m = 1; });
  refused([](StorefrontOptions& o) { o.least_yaw_deg = -61; });
  refused([](StorefrontOptions& o) { o.greatest_yaw_deg = -46; });
}

}  // namespace
}  // namespace pomona
