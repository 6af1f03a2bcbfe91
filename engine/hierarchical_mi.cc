#include "engine/hierarchical_mi.h"

#include <algorithm>

#include "core/parallel.h"
#include "engine/input.h"
#include "pyramid/scale.h"

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

/// Nearest-neighbour enlargement of a sparse map, disparities rescaled.
void enlarge(ImageView<const float> from, ImageView<float> to) {
  const float ratio = static_cast<float>(to.width) / static_cast<float>(from.width);
  for (int y = 0; y < to.height; ++y) {
    const float* source = from.row(y * from.height / to.height);
    for (int x = 0; x < to.width; ++x) to.row(y)[x] = ratio * source[x * from.width / to.width];
  }
}

}  // namespace

std::span<const std::uint8_t> HierarchicalMi::table(const MatchInput& pair,
                                                    const SparseStage::Settings& settings) {
  const int width = pair.left.width, height = pair.left.height;
  const PyramidKernels& kernels = pyramidKernels(settings.isa);
  Arena& scratch = *settings.scratch;
  const Arena::Scope scope(scratch);
  const auto guessOf = [&, whole = scratch.image<float>(width, height)](int w, int h) {
    return ImageView<float>{whole.data, w, h, whole.stride};
  };
  ImageView<float> guess;
  bool started = false;
  for (std::size_t i = 0; i < kFactors.size(); ++i) {
    const int w = scaledLength(width, kFactors[i]), h = scaledLength(height, kFactors[i]);
    if (!started && std::min(w, h) < kSmallestSide) continue;
    Level& level = levels_[i];
    const Arena::Scope level_scope(scratch);
    const auto shrunk = [&](ImageView<const std::uint8_t> in) {
      const auto out = scratch.image<std::uint8_t>(w, h);
      areaDownscale(GuideView{in.data, in.width, in.height, 1, in.stride}, out, scratch, kernels,
                    settings.threads);
      return out;
    };
    const auto left = shrunk(pair.left), right = shrunk(pair.right);

    SparseStage::Settings at_level = settings;
    at_level.match = scaledOptions(settings.match, static_cast<double>(width) / w, w);
    at_level.mask = shrunkMask(settings.mask, w, h, level.mask);
    const MatchInput small{left, right, {}, {}, {left.data, w, h, 1, left.stride}};
    if (!started) {
      guess = guessOf(w, h);
      fillRandomly(guess, at_level.match);
    }
    StageClock untimed;
    for (int k = 0; k < (started ? 1 : kIterationsAtStart); ++k) {
      mi_->update(small.left, small.right, guess);
      at_level.mutual_information = mi_->table();
      level.stage.run(small, at_level, untimed);
      enlarge(level.stage.maps().disparity.view(), guess);
    }
    started = true;
    const bool last = i + 1 == kFactors.size();
    guess = guessOf(last ? width : scaledLength(width, kFactors[i + 1]),
                    last ? height : scaledLength(height, kFactors[i + 1]));
    enlarge(level.stage.maps().disparity.view(), guess);
  }
  if (!started) {  // the pair itself is tiny
    guess = guessOf(width, height);
    fillRandomly(guess, settings.match);
  }
  mi_->update(pair.left, pair.right, guess);
  return mi_->table();
}

}  // namespace pomona
