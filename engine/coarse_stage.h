// The coarse maps: the pair matched at a quarter and at a fifth of its size, completed under the guidance of
// the image, enlarged again and fused. A smooth, dense, low-resolution opinion on every pixel.
#pragma once

#include <array>

#include "engine/hierarchical_mi.h"
#include "engine/sparse_stage.h"

namespace pomona {

class CoarseStage {
 public:
  /// `settings` are those of the full size. Returns a dense map of the pair's size, in its pixels, in the
  /// current scope of settings.scratch; all NaN if neither scale measured anything.
  ImageView<const float> run(const MatchInput& pair, const SparseStage::Settings& settings,
                             const CompletionOptions& completion);

 private:
  struct Scale {
    Image<std::uint8_t> mask;
    HierarchicalMi mutual_information;
    SparseStage sparse;
  };
  static constexpr std::array<int, 2> kFactors = {4, 5};

  void completeScale(Scale& scale, int factor, const MatchInput& pair, const SparseStage::Settings& settings,
                     const CompletionOptions& completion, ImageView<float> enlarged);

  std::array<Scale, kFactors.size()> scales_;
};

}  // namespace pomona
