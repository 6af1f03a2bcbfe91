#include "sgm/matcher.h"

#include <algorithm>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {

void finishRow(const WinnerRow& w, int y, const MatchOptions& o, const SgmKernels& kernels, MatchMaps& out) {
  const int width = out.disparity.width();
  const auto refine = kernels.refine[static_cast<int>(o.winner.subpixel)];
  refine({width, o.disparities, o.min_disparity, w.index, w.best, w.below, w.above, out.disparity.row(y)});
  refine({width, o.disparities, o.min_disparity, w.right_index, w.right_best, w.right_below, w.right_above,
          out.right_disparity.row(y)});

  kernels.score({width, w.best, w.below, w.above, w.second, out.margin.row(y), out.curvature.row(y)});

  constexpr auto kMeasured = static_cast<std::uint8_t>(PixelState::kMeasured);
  std::uint8_t* state = out.state.row(y);
  std::fill_n(state, width, kMeasured);
  if (o.winner.uniqueness_percent == 0) return;
  const int keep_percent = 100 - o.winner.uniqueness_percent;
  for (int x = 0; x < width; ++x)
    if (100 * w.best[x] > keep_percent * w.second[x])
      state[x] = static_cast<std::uint8_t>(PixelState::kAmbiguous);
}

void MatchMaps::resize(int width, int height) {
  disparity.resize(width, height);
  right_disparity.resize(width, height);
  margin.resize(width, height);
  curvature.resize(width, height);
  state.resize(width, height);
}

MatchingCostRows::Features SgmMatcher::extract(ImageView<const std::uint8_t> gray,
                                               ImageView<const std::uint16_t> gray16, MatchingCost cost,
                                               View& view, const SgmKernels& kernels, int threads) {
  if (cost != MatchingCost::kMutualInformation) {
    if (gray16.empty())
      census_.compute(gray, cost, view.census, kernels, threads);
    else
      census16_.compute(gray16, cost, view.census, kernels, threads);
  }
  if (cost == MatchingCost::kBlended) sobel_.compute(gray, view.sobel, kernels, threads);
  return {&view.census, view.sobel.view(), gray};
}

void SgmMatcher::findWinners(const MatchInput& pair, const MatchOptions& options,
                             std::span<const std::uint8_t> table, const SgmKernels& kernels, WinnerSink sink,
                             int threads) {
  const MatchingCost kind = options.cost.cost;
  const DisparityRange range = makeRange(options.min_disparity, options.disparities, kernels);

  const auto left = extract(pair.left, pair.left16, kind, left_, kernels, threads);
  const auto right = extract(pair.right, pair.right16, kind, right_, kernels, threads);
  if (kind == MatchingCost::kMutualInformation)
    cost_.prepareTable(left, right, table.first<65536>(), maximumCost(kind), range, kernels, threads);
  else if (kind == MatchingCost::kBlended)
    cost_.prepareBlended(left, right, maximumCost(kind), range, kernels, threads);
  else
    cost_.prepareCensus(left, right, maximumCost(kind), range, kernels, threads);

  const bool adapts = options.aggregation.adaptation != PenaltyAdaptation::kConstant;
  if (adapts || options.cost.support_color_step > 0) steps_.compute(pair.guide, kernels, threads);
  cost_.prepareSupport(steps_, options.cost.support_color_step, threads);
  if (!pair.prior.empty())
    cost_.preparePrior(pair.prior, options.prior_weight, options.prior_reach_px, threads);
  aggregator_.run(cost_, steps_, options.aggregation, options.memory, kernels, sink, threads);
}

void SgmMatcher::match(const MatchInput& pair, const MatchOptions& options,
                       std::span<const std::uint8_t> table, const SgmKernels& kernels, MatchMaps& out,
                       int threads) {
  out.resize(pair.left.width, pair.left.height);
  const auto finish = [&](int y, const WinnerRow& winners) { finishRow(winners, y, options, kernels, out); };
  findWinners(pair, options, table, kernels, finish, threads);
}

}  // namespace pomona
