#include "datasets/rendering/sightings.h"

#include <algorithm>
#include <limits>

namespace pomona {
namespace {

// Which of `surfaces` each surface of the scene is, or -1.
std::vector<int> numbersOf(const SceneDescription& scene, const std::vector<int>& surfaces) {
  std::vector<int> numbers(scene.surfaces.size(), -1);
  for (std::size_t i = 0; i < surfaces.size(); ++i) numbers.at(surfaces[i]) = static_cast<int>(i);
  return numbers;
}

// Calls see(number, y, x) for the pixels of the left view that show one of `surfaces`.
template <typename See>
void forEachPixel(const SceneDescription& scene, const RenderedPair& pair, const std::vector<int>& surfaces,
                  See see) {
  const std::vector<int> numbers = numbersOf(scene, surfaces);
  for (int y = 0; y < pair.left.surface.rows; ++y)
    for (int x = 0; x < pair.left.surface.cols; ++x)
      if (const int surface = pair.left.surface.at<int>(y, x); surface >= 0 && numbers[surface] >= 0)
        see(numbers[surface], y, x);
}

}  // namespace

std::vector<Sighting> sightings(const SceneDescription& scene, const RenderedPair& pair,
                                const std::vector<int>& surfaces) {
  std::vector<Sighting> found(surfaces.size());
  std::vector<int> seen_by_both(surfaces.size());
  std::vector<float> largest_disparity(surfaces.size(), -std::numeric_limits<float>::infinity());
  forEachPixel(scene, pair, surfaces, [&](int number, int y, int x) {
    ++found[number].visible_px;
    seen_by_both[number] += pair.left.mask.at<std::uint8_t>(y, x) == 255;
    largest_disparity[number] = std::max(largest_disparity[number], pair.left.disparity.at<float>(y, x));
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    Sighting& s = found[i];
    const Outline outline = outlineOf(scene, surfaces[i]);
    s.box_px = outline.box_px;
    s.nearest_z_m = std::numeric_limits<double>::quiet_NaN();
    if (s.visible_px == 0) continue;
    s.visible_share = 1.0 * s.visible_px / outline.pixels;
    s.seen_by_both = 1.0 * seen_by_both[i] / s.visible_px;
    s.nearest_z_m = scene.focal_px * scene.baseline_m / (double{largest_disparity[i]} + scene.doffs_px);
  }
  return found;
}

cv::Mat labelsOf(const SceneDescription& scene, const RenderedPair& pair, const std::vector<int>& surfaces) {
  cv::Mat labels(pair.left.surface.size(), CV_16UC1, cv::Scalar(0));
  forEachPixel(scene, pair, surfaces, [&](int number, int y, int x) {
    labels.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1 + number);
  });
  return labels;
}

}  // namespace pomona
