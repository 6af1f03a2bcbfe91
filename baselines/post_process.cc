#include "baselines/post_process.h"

#include <cmath>

#include "core/cpu.h"
#include "filters/left_right.h"
#include "filters/median.h"
#include "filters/speckle.h"
#include "pyramid/hole_fill.h"

namespace pomona {

void validate(WindowMaps& maps, SearchRange range, const ValidationOptions& validation, int threads) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  Arena scratch;
  if (validation.left_right_px >= 0) {
    leftRightCheck(maps.disparity.view(), maps.state.view(), maps.right_disparity.view(),
                   {validation.left_right_px, range.min, range.count}, filterKernels(chooseIsa("")), threads);
  }
  if (validation.speckle_size_px > 0) {
    removeSpeckles(maps.disparity.view(), maps.state.view(), validation.speckle_size_px,
                   validation.speckle_step_px, scratch, filterKernels(chooseIsa("")), threads);
  }
  if (validation.median_size > 0) {
    medianFilter(maps.disparity.view(), maps.disparity.view(), validation.median_size,
                 filterKernels(chooseIsa("")), scratch, threads);
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (std::isnan(maps.disparity.row(y)[x])) maps.confidence.row(y)[x] = 0;
}

void fill(WindowMaps& maps, GuideView guide, SearchRange range, int threads) {
  const auto no_coarse_map = [] { return ImageView<const float>(); };
  Arena scratch;
  fillHoles({.guide = guide,
             .right_disparity = maps.right_disparity.view(),
             .coarse = no_coarse_map,
             .search_radius_px = CompletionOptions().search_radius_px,
             .fallback_disparity = static_cast<float>(range.min)},
            maps.disparity.view(), maps.state.view(), scratch, pyramidKernels(chooseIsa("")), threads);
}

}  // namespace pomona
