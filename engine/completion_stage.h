// From the sparse map of a pair to a dense one.
#pragma once

#include "engine/coarse_stage.h"
#include "engine/sparse_stage.h"

namespace pomona {

class CompletionStage {
 public:
  /// Gives every pixel of `maps` that the mask does not exclude a disparity within the searched range, by
  /// `options.method`: kFillHoles completes and refines the sparse map that `maps` holds, kPaper does not
  /// look at it and only sets disparity and state. `settings` are those of the sparse stage.
  void run(const MatchInput& pair, const SparseStage::Settings& settings, const CompletionOptions& options,
           MatchMaps& maps, StageClock& clock);

 private:
  void fillHolesOf(const MatchInput& pair, const SparseStage::Settings& settings,
                   const CompletionOptions& options, MatchMaps& maps, StageClock& clock);
  void takeCoarse(const MatchInput& pair, const SparseStage::Settings& settings,
                  const CompletionOptions& options, MatchMaps& maps);

  CoarseStage coarse_;
};

}  // namespace pomona
