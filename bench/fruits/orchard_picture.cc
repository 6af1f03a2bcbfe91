#include "bench/fruits/orchard_picture.h"

#include "datasets/rendering/orchard.h"
#include "datasets/rendering/sightings.h"

namespace pomona {

CameraEffects usualEffects(std::uint64_t seed) {
  CameraEffects effects;
  effects.blur_px = 0.5;
  effects.shot_noise = 2;
  effects.read_noise = 1;
  effects.right_gain = 1.03;
  effects.noise_seed = seed;
  return effects;
}

OrchardPicture takePicture(const SceneDescription& cameras, const Band& band, std::uint64_t seed,
                           const CameraEffects& effects) {
  OrchardOptions options;
  options.seed = seed;
  options.nearest_m = band.nearest_m;
  options.farthest_m = band.farthest_m;
  const Orchard trees = orchard(cameras, options);
  std::vector<int> surfaces;
  for (const Fruit& fruit : trees.fruits) surfaces.push_back(fruit.surface);

  OrchardPicture picture;
  picture.pair = render(trees.scene, effects);
  picture.labels = labelsOf(trees.scene, picture.pair, surfaces);
  const std::vector<Sighting> seen = sightings(trees.scene, picture.pair, surfaces);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i].visible_share >= kLeastVisible)
      picture.fruits.push_back({static_cast<int>(i) + 1, seen[i].visible_share, seen[i].box_px,
                                trees.fruits[i].near_distance_m, trees.fruits[i].distance_m});
  return picture;
}

}  // namespace pomona
