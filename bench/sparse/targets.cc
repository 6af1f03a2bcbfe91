#include "bench/sparse/targets.h"

#include <algorithm>

#include "datasets/hash.h"
#include "datasets/render.h"
#include "datasets/rendering/angle.h"
#include "datasets/rendering/named_rigs.h"

namespace pomona {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr double kFocal_mm = 6, kSensorWidth_mm = 3.2, kBaseline_m = 0.06;
constexpr double kFocal_px = kFocal_mm / kSensorWidth_mm * kWidth;
constexpr double kNearest_m = 0.15;

TargetPair targetAt(double distance_m, std::uint64_t seed) {
  SceneDescription scene;
  scene.width = kWidth;
  scene.height = kHeight;
  scene.focal_px = kFocal_px;
  scene.baseline_m = kBaseline_m;
  scene.seed = seed;
  Random random(seed);
  const double m_per_px = distance_m / kFocal_px;
  const double common_px = kWidth - kFocal_px * kBaseline_m / distance_m;  // of the width, seen by both
  const double half_m = std::min(0.2, 0.15 * common_px * m_per_px);
  const double room_m = 0.5 * common_px * m_per_px - half_m;
  const cv::Vec3d middle{kBaseline_m / 2 + random.between(-0.6, 0.6) * room_m,
                         random.between(-0.3, 0.3) * kHeight * m_per_px, distance_m};
  const double wall_m = 1.6 * distance_m + 1;
  const Paint poster{{50, 60, 60}, {180, 190, 190}, 16 * m_per_px, Pattern::kMottle};
  const Paint plaster{{110, 115, 120}, {150, 155, 160}, 30 * wall_m / kFocal_px, Pattern::kMottle};
  const cv::Vec2d turn = cosineAndSine(random.between(-30, 30));
  scene.surfaces.push_back({Shape::kParallelogram,
                            middle,
                            cv::Vec3d{turn[0], 0, turn[1]} * half_m,
                            {0, 0.75 * half_m, 0},
                            0,
                            poster});
  scene.surfaces.push_back({Shape::kPlane, {0, 0, wall_m}, {1, 0, 0}, {0, 1, 0}, 0, plaster});
  scene.num_disparities = (static_cast<int>(kFocal_px * kBaseline_m / distance_m) + 16) / 16 * 16;
  shiftRightView(0.4, scene);
  CameraEffects effects;
  effects.blur_px = 0.7;
  effects.vignetting = 0.2;
  effects.right_gain = 1.05;
  effects.shot_noise = 4;
  effects.read_noise = 2;
  effects.noise_seed = seed;
  const RenderedPair pair = render(scene, effects);
  const cv::Mat mask = (pair.left.surface == 0) & (pair.left.mask == 255);
  return {pair.left.image, pair.right.image, depthFromDisparity(pair.left.disparity, pair.calibration), mask,
          pair.calibration};
}

}  // namespace

const std::vector<DistanceBin>& distanceBins() {
  static const std::vector<DistanceBin> bins{{0.1, 1, 1.55}, {1, 2, 2.2}, {2, 3, 3.75}, {3, 10, 5.81}};
  return bins;
}

std::vector<TargetPair> targetPairs(const DistanceBin& bin, int count) {
  const double nearest_m = std::max(kNearest_m, bin.nearest_m);
  std::vector<TargetPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double distance_m = nearest_m + (bin.farthest_m - nearest_m) * (i + 0.5) / count;
    pairs.push_back(targetAt(distance_m, static_cast<std::uint64_t>(1000 * distance_m)));
  }
  return pairs;
}

}  // namespace pomona
