#include "engine/pipeline.h"

#include <utility>

#include "core/parallel.h"
#include "engine/trust.h"

namespace pomona {

void Pipeline::run(const MatchInput& pair, ImageView<const std::uint8_t> mask, StageClock& clock) {
  const SparseStage::Settings s = settings(mask);
  if (!isPaper()) {
    if (options_.adaptive_range) {
      bands_ = search_bands_.plan(pair, s);
      clock.lap("search range");
    }
    match(pair, s, clock);
  }
  if (isDense()) completion_.run(pair, s, options_.completion, maps(), clock);
  if (matchesTwice()) matchAgain(pair, s, clock);
}

SparseStage::Settings Pipeline::settings(ImageView<const std::uint8_t> mask) const {
  SparseStage::Settings s;
  s.match = {options_.min_disparity, options_.num_disparities, options_.cost,
             options_.aggregation,   options_.winner,          options_.memory};
  s.validation = options_.validation;
  if (isDense() && !isPaper()) {
    s.validation.left_right_px = options_.completion.seed_left_right_px;
    s.validation.speckle_size_px = options_.completion.seed_speckle_size_px;
  }
  s.mask = mask;
  s.isa = isa_;
  s.threads = threads_;
  return s;
}

void Pipeline::match(const MatchInput& pair, const SparseStage::Settings& settings, StageClock& clock) {
  SparseStage::Settings with_table = settings;
  if (options_.cost.cost == MatchingCost::kMutualInformation) {
    with_table.mutual_information = mutual_information_.table(pair, settings);
    clock.lap("mutual information");
  }
  sparse_.run(pair, with_table, clock, bands_);
}

void Pipeline::noteBarePixels() {
  const MatchMaps& first = maps();
  bare_.resize(first.margin.width(), first.margin.height());
  const int largest = largestSum(options_);
  parallelStrips(threads_, bare_.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < bare_.width(); ++x)
        bare_.row(y)[x] = nothingStandsOut(first.margin.row(y)[x], first.curvature.row(y)[x], largest);
  });
}

/// Where nothing stood out in the first match, what does in the second is what it was drawn to.
void Pipeline::keepBarePixels() {
  MatchMaps& second = maps();
  parallelStrips(threads_, bare_.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < bare_.width(); ++x)
        if (bare_.row(y)[x]) second.margin.row(y)[x] = second.curvature.row(y)[x] = 0;
  });
}

/// The second pass: the completed map, which maps() holds, becomes the prior of another match.
void Pipeline::matchAgain(const MatchInput& pair, const SparseStage::Settings& settings, StageClock& clock) {
  noteBarePixels();
  std::swap(first_map_, maps().disparity);
  MatchInput views = pair;
  views.prior = first_map_.view();
  SparseStage::Settings again = settings;
  again.match.cost = options_.second_pass.cost;
  again.match.aggregation = options_.second_pass.aggregation;
  again.match.prior_weight = options_.second_pass.weight;
  again.match.prior_reach_px = options_.second_pass.reach_px;
  sparse_.run(views, again, clock, bands_);
  keepBarePixels();
  completion_.run(pair, settings, options_.completion, maps(), clock);
}

}  // namespace pomona
