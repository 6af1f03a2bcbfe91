#include "sgm/matcher.h"

#include <algorithm>
#include <limits>

#include "pomona/pixel_state.h"
#include "sgm/census.h"
#include "sgm/color_steps.h"
#include "sgm/sobel.h"

namespace pomona {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

PartnerColumns PartnerColumns::of(int width, int min_disparity, int disparities) {
  const int left = std::max(0, min_disparity), right = std::max(0, 1 - min_disparity - disparities);
  return {left, right, width - left - right};
}

SubpixelCurve subpixelCurve(int paths) {
  return paths == 8 ? SubpixelCurve{0.42f, 0.5f - 0.42f, 0} : SubpixelCurve{0.49f, -0.375f, 0.385f};
}

void finishRow(const WinnerRow& w, int y, const PartnerColumns& columns, const MatchOptions& o,
               const SgmKernels& kernels, MatchMaps& out) {
  const int left = columns.left, width = columns.width, all = out.disparity.width();
  float *disparity = out.disparity.row(y), *right_disparity = out.right_disparity.row(y);
  std::uint16_t *margin = out.margin(y), *curvature = out.curvature(y);
  std::uint8_t* state = out.state.row(y);
  const auto leaveOut = [&](int begin, int end) {
    std::fill(disparity + begin, disparity + end, kNan);
    std::fill(margin + begin, margin + end, std::uint16_t{0});
    std::fill(curvature + begin, curvature + end, std::uint16_t{0});
    std::fill(state + begin, state + end, static_cast<std::uint8_t>(PixelState::kOutOfRange));
  };
  leaveOut(0, left);
  leaveOut(left + width, all);
  std::fill(right_disparity, right_disparity + columns.right, kNan);
  std::fill(right_disparity + columns.right + width, right_disparity + all, kNan);

  const auto refine = kernels.refine[static_cast<int>(o.winner.subpixel)];
  const SubpixelCurve curve = subpixelCurve(o.aggregation.paths);
  refine({width, o.disparities, o.min_disparity, w.index, w.best, w.below, w.above, disparity + left, curve});
  refine({width, o.disparities, o.min_disparity, w.right_index, w.right_best, w.right_below, w.right_above,
          right_disparity + columns.right, curve});
  kernels.score({width, w.best, w.below, w.above, w.second, margin + left, curvature + left});

  std::fill_n(state + left, width, static_cast<std::uint8_t>(PixelState::kMeasured));
  if (o.winner.uniqueness_percent == 0) return;
  const int keep_percent = 100 - o.winner.uniqueness_percent;
  for (int x = 0; x < width; ++x)
    if (100 * w.best[x] > keep_percent * w.second[x])
      state[left + x] = static_cast<std::uint8_t>(PixelState::kAmbiguous);
}

namespace {

/// What a view is compared by; in the current scope of an arena.
struct View {
  View(ImageView<const std::uint8_t> gray8, ImageView<const std::uint16_t> gray16, MatchingCost cost,
       const SgmKernels& kernels, Arena& arena, int threads)
      : gray(gray8) {
    if (cost != MatchingCost::kMutualInformation)
      census = gray16.empty() ? computeCensus(gray, cost, kernels, arena, threads)
                              : computeCensus(gray16, cost, kernels, arena, threads);
    if (cost == MatchingCost::kBlended) sobel = computeSobel(gray, kernels, arena, threads);
  }
  MatchingCostRows::Features features() const { return {&census, sobel, gray}; }

  ImageView<const std::uint8_t> gray, sobel;
  CensusPlanes census;
};

}  // namespace

void MatchMaps::resize(int width, int height) {
  disparity.resize(width, height);
  right_disparity.resize(width, height);
  scores.resize(2 * width, height);
  state.resize(width, height);
}

void SgmMatcher::findWinners(const MatchInput& pair, const MatchOptions& options,
                             std::span<const std::uint8_t> table, const SgmKernels& kernels, WinnerSink sink,
                             Arena& scratch, int threads) {
  const Arena::Scope scope(scratch);
  const MatchingCost kind = options.cost.cost;
  const DisparityRange range = makeRange(options.min_disparity, options.disparities, kernels);
  const int maximum = maximumCost(kind);
  const View left(pair.left, pair.left16, kind, kernels, scratch, threads);
  if (kind == MatchingCost::kMutualInformation)
    cost_.startTable(left.features(), table.first<65536>(), maximum, range, kernels, scratch);
  else if (kind == MatchingCost::kBlended)
    cost_.startBlended(left.features(), maximum, range, kernels, scratch);
  else
    cost_.startCensus(left.features(), maximum, range, kernels, scratch);
  {
    const Arena::Scope right_scope(scratch);
    const View right(pair.right, pair.right16, kind, kernels, scratch, threads);
    cost_.setRight(right.features(), threads);
  }

  const ColorSteps steps(pair.guide, kernels);
  cost_.prepareSupport(steps, options.cost.support_color_step, scratch, threads);
  if (!pair.prior.empty())
    cost_.preparePrior(pair.prior, options.prior_shift_px, options.prior_weight, options.prior_reach_px,
                       scratch, threads);
  aggregate(cost_, steps, options.aggregation, options.memory, kernels, sink, scratch, threads);
}

void SgmMatcher::match(const MatchInput& pair, const MatchOptions& options,
                       std::span<const std::uint8_t> table, const SgmKernels& kernels, MatchMaps& out,
                       Arena& scratch, int threads) {
  out.resize(pair.left.width, pair.left.height);
  const PartnerColumns all{0, 0, pair.left.width};
  const auto finish = [&](int y, const WinnerRow& winners) {
    finishRow(winners, y, all, options, kernels, out);
  };
  findWinners(pair, options, table, kernels, finish, scratch, threads);
}

}  // namespace pomona
