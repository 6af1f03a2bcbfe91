#include "engine/coarse_stage.h"

#include <algorithm>
#include <cmath>

#include "engine/input.h"
#include "filters/joint_bilateral.h"
#include "pyramid/fusion.h"
#include "pyramid/scale.h"

namespace pomona {

void CoarseStage::completeScale(Scale& s, int factor, const MatchInput& pair,
                                const SparseStage::Settings& settings, const CompletionOptions& completion,
                                ImageView<float> enlarged) {
  Arena& scratch = *settings.scratch;
  const Arena::Scope scope(scratch);
  const GuideView guide = pair.guide;
  const int width = guide.width, height = guide.height, threads = settings.threads;
  const int w = scaledLength(width, factor), h = scaledLength(height, factor);
  const PyramidKernels& kernels = pyramidKernels(settings.isa);
  const auto shrunk = [&](GuideView in) {
    const auto out = scratch.image<std::uint8_t>(w * in.channels, h);
    areaDownscale(in, out, scratch, kernels, threads);
    return out;
  };
  const auto left = shrunk({pair.left.data, width, height, 1, pair.left.stride});
  const auto right = shrunk({pair.right.data, width, height, 1, pair.right.stride});
  const auto colors = shrunk(guide);
  const GuideView small_guide{colors.data, w, h, guide.channels, colors.stride};
  const MatchInput small{left, right, {}, {}, small_guide};

  const double ratio = static_cast<double>(width) / w;
  SparseStage::Settings at_scale = settings;
  at_scale.match = scaledOptions(settings.match, ratio, w);
  at_scale.validation.speckle_size_px =
      static_cast<int>(std::lround(settings.validation.speckle_size_px / (ratio * ratio)));
  at_scale.mask = shrunkMask(settings.mask, w, h, s.mask);
  if (settings.match.cost.cost == MatchingCost::kMutualInformation)
    at_scale.mutual_information = s.mutual_information.table(small, at_scale);
  StageClock untimed;
  s.sparse.run(small, at_scale, untimed);

  const auto completed = scratch.image<float>(w, h);
  completeByBilateral(s.sparse.maps().disparity.view(), small_guide,
                      {completion.sigma_space_px, completion.sigma_range, BilateralTarget::kEveryPixel},
                      completed, scratch, filterKernels(settings.isa), threads);
  bicubicUpscale(completed, enlarged, scratch, kernels, threads);
  scaleDisparity(enlarged, static_cast<float>(ratio), threads);
}

ImageView<const float> CoarseStage::run(const MatchInput& pair, const SparseStage::Settings& settings,
                                        const CompletionOptions& completion) {
  Arena& scratch = *settings.scratch;
  const auto fullSize = [&] { return scratch.image<float>(pair.guide.width, pair.guide.height); };
  const ImageView<float> a = fullSize();
  const Arena::Scope scope(scratch);
  const ImageView<float> b = fullSize();
  completeScale(scales_[0], kFactors[0], pair, settings, completion, a);
  completeScale(scales_[1], kFactors[1], pair, settings, completion, b);

  // A scale is all known or all unknown; where one is unknown the other one stands alone.
  if (std::isnan(b.at(0, 0))) return a;
  if (std::isnan(a.at(0, 0)))
    for (int y = 0; y < a.height; ++y) std::copy_n(b.row(y), b.width, a.row(y));
  else
    fuseEqual(a, b, completion.pyramid_levels, a, scratch, pyramidKernels(settings.isa), settings.threads);
  return a;
}

}  // namespace pomona
