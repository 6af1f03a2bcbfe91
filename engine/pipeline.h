// The stages of a frame, from checked views to the final disparities.
#pragma once

#include <cstdint>
#include <span>

#include "engine/completion_stage.h"
#include "engine/hierarchical_mi.h"
#include "engine/search_bands.h"
#include "engine/sparse_stage.h"
#include "pomona/options.h"

namespace pomona {

class Pipeline {
 public:
  /// `options` must be valid, `threads` at least 1.
  Pipeline(const Options& options, Isa isa, int threads) : options_(options), isa_(isa), threads_(threads) {}

  /// `mask`: empty, or 0 where a pixel is excluded. Afterwards maps() holds the result.
  void run(const MatchInput& pair, ImageView<const std::uint8_t> mask, StageClock& clock);

  MatchMaps& maps() { return sparse_.maps(); }
  const FilterKernels& filterKernels() const { return pomona::filterKernels(isa_); }
  /// The largest sum of matching costs over the paths of the last match, whose margins maps() holds.
  int largestCostSum() const {
    return matchesTwice() ? largestSum(options_.second_pass) : largestSum(options_);
  }

 private:
  /// Of the first match with Options, of the second with SecondPassOptions.
  template <typename MatchSettings>
  static int largestSum(const MatchSettings& o) {
    return o.aggregation.paths * maximumCost(o.cost.cost);
  }
  bool isDense() const { return options_.mode == OutputMode::kDense; }
  bool isPaper() const { return isDense() && options_.completion.method == CompletionMethod::kPaper; }
  bool matchesTwice() const { return isDense() && !isPaper() && options_.second_pass.enabled; }
  SparseStage::Settings settings(ImageView<const std::uint8_t> mask) const;
  void match(const MatchInput& pair, const SparseStage::Settings& settings, StageClock& clock);
  void noteBarePixels();
  void keepBarePixels();
  void matchAgain(const MatchInput& pair, const SparseStage::Settings& settings, StageClock& clock);

  Options options_;
  Isa isa_;
  int threads_;
  HierarchicalMi mutual_information_;
  SearchBands search_bands_;
  std::span<const SearchBand> bands_;  // none: the frame at once, over the whole range
  SparseStage sparse_;
  CompletionStage completion_;
  Image<float> first_map_;
  Image<std::uint8_t> bare_;  // whether nothing stood out in the first match
};

}  // namespace pomona
