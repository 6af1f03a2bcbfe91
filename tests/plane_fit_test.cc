#include "pyramid/plane_fit.h"

#include "tests/pyramid_support.h"

namespace pomona {
namespace {

struct Random {
  std::mt19937 engine{3};
  float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine); }
};

PlanePoints planeWithOutliers(const DisparityPlane& plane, int count, int outlier_percent, float noise) {
  PlanePoints points;
  Random random;
  for (int i = 0; i < count; ++i) {
    const float x = random.uniform(0, 60), y = random.uniform(0, 40);
    const bool is_outlier = random.uniform(0, 100) < static_cast<float>(outlier_percent);
    points.add(x, y, is_outlier ? random.uniform(-100, 100) : plane.at(x, y) + random.uniform(-noise, noise));
  }
  return points;
}

TEST(PlaneFit, FindsThePlaneAmongOutliersAlikeOnEveryInstructionSet) {
  for (const DisparityPlane plane : {DisparityPlane{0, 0, 12}, {0.3f, -0.2f, 30}, {-0.59f, 0.59f, -7}})
    for (int count : {24, 33, PlanePoints::kCapacity})
      for (int outlier_percent : {0, 30, 60}) {
        const PlanePoints points = planeWithOutliers(plane, count, outlier_percent, 0.3f);
        const PlaneFit want = fitPlane(points, 1, pyramidKernels(Isa::kScalar));
        EXPECT_GE(want.inliers, count * (100 - outlier_percent) * 0.008) << count << ' ' << outlier_percent;
        for (float x : {0.0f, 60.0f})
          for (float y : {0.0f, 40.0f})
            EXPECT_NEAR(want.plane.at(x, y), plane.at(x, y), count < 100 ? 0.4 : 0.15)
                << count << ' ' << outlier_percent;
        for (Isa isa : usableIsas()) {
          const PlaneFit fit = fitPlane(points, 1, pyramidKernels(isa));
          EXPECT_EQ(std::memcmp(&fit, &want, sizeof fit), 0) << name(isa) << ' ' << count;
        }
      }
}

TEST(PlaneFit, CountsInliersAndKnowsTheirRange) {
  PlanePoints points = planeWithOutliers({0.1f, 0.2f, 20}, 200, 0, 0);
  points.add(5, 5, 90);
  points.add(9, 2, -90);
  const PlaneFit fit = fitPlane(points, 7, pyramidKernels(usableIsas().back()));
  EXPECT_EQ(fit.inliers, 200);
  EXPECT_EQ(fit.low, *std::min_element(points.d, points.d + 200));
  EXPECT_EQ(fit.high, *std::max_element(points.d, points.d + 200));
}

TEST(PlaneFit, RefusesWhatNoVisibleSurfaceCanBe) {
  const PyramidKernels& kernels = pyramidKernels(Isa::kScalar);
  EXPECT_EQ(fitPlane(planeWithOutliers({1.5f, 0, 0}, 100, 0, 0), 1, kernels).inliers, 0);  // too steep
  PlanePoints line;
  for (int i = 0; i < 50; ++i) line.add(static_cast<float>(i), static_cast<float>(i), 5);
  EXPECT_EQ(fitPlane(line, 1, kernels).inliers, 0);  // no three points span a plane
}

TEST(PlaneFit, CountNearPlaneEqualsItsTwin) {
  Random random;
  for (int n : {0, 1, 7, 31, 33, 64, 65, 500}) {
    std::vector<float> x, y, d;
    int expected = 0;
    for (int i = 0; i < n; ++i) {
      x.push_back(random.uniform(-50, 50));
      y.push_back(random.uniform(-50, 50));
      d.push_back(i % 5 == 4 ? kNan : 0.25f * x[i] + 0.5f * y[i] + 3 + random.uniform(-2, 2));
      const float e = 0.25f * x[i] + 0.5f * y[i] + 3.0f - d[i];
      expected += std::fabs(e) < 1;
    }
    for (Isa isa : usableIsas())
      EXPECT_EQ(pyramidKernels(isa).countNearPlane(x.data(), y.data(), d.data(), n, 0.25f, 0.5f, 3, 1),
                expected)
          << name(isa) << ", n " << n;
  }
}

}  // namespace
}  // namespace pomona
