#include "engine/coarse_look.h"

#include <algorithm>
#include <cmath>

#include "engine/input.h"

namespace pomona {

const MatchMaps& CoarseLook::run(const MatchInput& pair, int min_disparity, int disparities,
                                 ImageView<const std::uint8_t> mask, Isa isa, int threads) {
  constexpr int kUniquePercent = 10;
  const int width = scaledLength(pair.left.width, kFactor), height = scaledLength(pair.left.height, kFactor);
  ratio_ = static_cast<double>(pair.left.width) / width;
  const auto shrink = [&](ImageView<const std::uint8_t> in, Image<std::uint8_t>& out) {
    areaDownscale(GuideView{in.data, in.width, in.height, 1, in.stride}, out, width, height, scale_,
                  pyramidKernels(isa), threads);
  };
  shrink(pair.left, left_);
  shrink(pair.right, right_);

  const Options preset = Options::preset("fast");
  SparseStage::Settings settings;
  settings.match = scaledOptions({min_disparity, disparities, preset.cost, preset.aggregation, preset.winner},
                                 ratio_, width);
  settings.match.winner.uniqueness_percent = kUniquePercent;
  settings.validation = preset.validation;
  settings.mask = shrunkMask(mask, width, height, mask_);
  settings.isa = isa;
  settings.threads = threads;
  StageClock untimed;
  stage_.run({left_.view(), right_.view(), {}, {}, {left_.row(0), width, height, 1, left_.view().stride}},
             settings, untimed);
  return stage_.maps();
}

bool CoarseLook::hasFound(int y, int x) const {
  constexpr int kReach = 2, kLeastContrast = 2;
  if (std::isnan(stage_.maps().disparity.row(y)[x])) return false;
  const std::uint8_t* gray = left_.row(y);
  const auto [low, high] =
      std::minmax_element(gray + std::max(0, x - kReach), gray + std::min(left_.width(), x + kReach + 1));
  return *high - *low >= kLeastContrast;
}

}  // namespace pomona
