#include "engine/coarse_stage.h"

#include <algorithm>
#include <cmath>

#include "engine/input.h"

namespace pomona {

void CoarseStage::completeScale(Scale& s, int factor, const MatchInput& pair,
                                const SparseStage::Settings& settings, const CompletionOptions& completion) {
  const GuideView guide = pair.guide;
  const int width = guide.width, height = guide.height, threads = settings.threads;
  const int w = scaledLength(width, factor), h = scaledLength(height, factor);
  const PyramidKernels& kernels = pyramidKernels(settings.isa);
  const auto shrink = [&](GuideView in, Image<std::uint8_t>& out) {
    areaDownscale(in, out, w, h, scale_scratch_, kernels, threads);
  };
  shrink({pair.left.data, width, height, 1, pair.left.stride}, s.left);
  shrink({pair.right.data, width, height, 1, pair.right.stride}, s.right);
  shrink(guide, s.guide);
  const GuideView small_guide{s.guide.row(0), w, h, guide.channels, s.guide.view().stride};
  const MatchInput small{s.left.view(), s.right.view(), {}, {}, small_guide};

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

  s.completed.resize(w, h);
  completeByBilateral(s.sparse.maps().disparity.view(), small_guide,
                      {completion.sigma_space_px, completion.sigma_range, BilateralTarget::kEveryPixel},
                      s.completed.view(), s.bilateral, filterKernels(settings.isa), threads);
  s.enlarged.resize(width, height);
  bicubicUpscale(s.completed.view(), s.enlarged.view(), scale_scratch_, kernels, threads);
  scaleDisparity(s.enlarged.view(), static_cast<float>(ratio), threads);
}

ImageView<const float> CoarseStage::run(const MatchInput& pair, const SparseStage::Settings& settings,
                                        const CompletionOptions& completion) {
  for (std::size_t i = 0; i < kFactors.size(); ++i)
    completeScale(scales_[i], kFactors[i], pair, settings, completion);

  // A scale is all known or all unknown; where one is unknown the other one stands alone.
  const Image<float>&a = scales_[0].enlarged, &b = scales_[1].enlarged;
  if (std::isnan(a.row(0)[0])) return b.view();
  if (std::isnan(b.row(0)[0])) return a.view();
  fused_.resize(a.width(), a.height());
  fuseEqual(a.view(), b.view(), completion.pyramid_levels, fused_.view(), fusion_,
            pyramidKernels(settings.isa), settings.threads);
  return fused_.view();
}

}  // namespace pomona
