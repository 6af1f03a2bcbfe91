// The coarse maps: the pair matched at a quarter and at a fifth of its size, completed under the guidance of
// the image, enlarged again and fused. A smooth, dense, low-resolution opinion on every pixel.
#pragma once

#include <array>

#include "engine/hierarchical_mi.h"
#include "engine/sparse_stage.h"
#include "filters/joint_bilateral.h"
#include "pyramid/fusion.h"
#include "pyramid/scale.h"

namespace pomona {

class CoarseStage {
 public:
  /// `settings` are those of the full size. Returns a dense map of the pair's size, in its pixels, valid
  /// until the next call; all NaN if neither scale measured anything.
  ImageView<const float> run(const MatchInput& pair, const SparseStage::Settings& settings,
                             const CompletionOptions& completion);

 private:
  struct Scale {
    Image<std::uint8_t> left, right, guide, mask;
    HierarchicalMi mutual_information;
    SparseStage sparse;
    BilateralScratch bilateral;
    Image<float> completed, enlarged;
  };
  static constexpr std::array<int, 2> kFactors = {4, 5};

  void completeScale(Scale& scale, int factor, const MatchInput& pair, const SparseStage::Settings& settings,
                     const CompletionOptions& completion);

  std::array<Scale, kFactors.size()> scales_;
  ScaleScratch scale_scratch_;
  FusionScratch fusion_;
  Image<float> fused_;
};

}  // namespace pomona
