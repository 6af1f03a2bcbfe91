#include "engine/hierarchical_mi.h"

#include <algorithm>

#include "core/parallel.h"
#include "engine/input.h"

namespace pomona {
namespace {

constexpr int kSmallestSide = 16;  // a level below this has too few pixels for a joint histogram

/// Any disparities will do to start from, as long as they are the same ones every time.
void fillRandomly(ImageView<float> map, const MatchOptions& o) {
  std::uint32_t state = 1;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      state = state * 1664525u + 1013904223u;
      map.at(y, x) = static_cast<float>(o.min_disparity + static_cast<int>((state >> 8) % o.disparities));
    }
}

}  // namespace

/// Nearest-neighbour enlargement of a sparse map, disparities rescaled; into guess_.
void HierarchicalMi::enlarge(ImageView<const float> from, int width, int height) {
  guess_.resize(width, height);
  const float ratio = static_cast<float>(width) / static_cast<float>(from.width);
  for (int y = 0; y < height; ++y) {
    const float* source = from.row(y * from.height / height);
    for (int x = 0; x < width; ++x) guess_.row(y)[x] = ratio * source[x * from.width / width];
  }
}

std::span<const std::uint8_t> HierarchicalMi::table(const MatchInput& pair,
                                                    const SparseStage::Settings& settings) {
  const int width = pair.left.width, height = pair.left.height;
  const PyramidKernels& kernels = pyramidKernels(settings.isa);
  bool started = false;
  for (std::size_t i = 0; i < kFactors.size(); ++i) {
    const int w = scaledLength(width, kFactors[i]), h = scaledLength(height, kFactors[i]);
    if (!started && std::min(w, h) < kSmallestSide) continue;
    Level& level = levels_[i];
    const auto shrink = [&](ImageView<const std::uint8_t> in, Image<std::uint8_t>& out) {
      areaDownscale(GuideView{in.data, in.width, in.height, 1, in.stride}, out, w, h, scale_, kernels,
                    settings.threads);
    };
    shrink(pair.left, level.left);
    shrink(pair.right, level.right);

    SparseStage::Settings at_level = settings;
    at_level.match = scaledOptions(settings.match, static_cast<double>(width) / w, w);
    at_level.mask = shrunkMask(settings.mask, w, h, level.mask);
    const MatchInput small{level.left.view(),
                           level.right.view(),
                           {},
                           {},
                           {level.left.row(0), w, h, 1, level.left.view().stride}};
    if (!started) {
      guess_.resize(w, h);
      fillRandomly(guess_.view(), at_level.match);
    }
    StageClock untimed;
    for (int k = 0; k < (started ? 1 : kIterationsAtStart); ++k) {
      mi_->update(small.left, small.right, guess_.view());
      at_level.mutual_information = mi_->table();
      level.stage.run(small, at_level, untimed);
      enlarge(level.stage.maps().disparity.view(), w, h);
    }
    started = true;
    const bool last = i + 1 == kFactors.size();
    enlarge(level.stage.maps().disparity.view(), last ? width : scaledLength(width, kFactors[i + 1]),
            last ? height : scaledLength(height, kFactors[i + 1]));
  }
  if (!started) {  // the pair itself is tiny
    guess_.resize(width, height);
    fillRandomly(guess_.view(), settings.match);
  }
  mi_->update(pair.left, pair.right, guess_.view());
  return mi_->table();
}

}  // namespace pomona
