#include "sgm/matcher.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

/// Offset of the minimum from the middle of three equidistant costs, in (-0.5, 0.5]. `best` is the smallest,
/// and smaller than `below`, so no denominator is zero.
float parabolaOffset(int below, int best, int above) {
  return 0.5f * static_cast<float>(below - above) / static_cast<float>(below + above - 2 * best);
}
float equiangularOffset(int below, int best, int above) {
  return 0.5f * static_cast<float>(below - above) / static_cast<float>(std::max(below, above) - best);
}

/// f(r) = 1/2 - a r - (1/2 - a) r^2 towards the smaller of the two sides, r their ratio; bench/subpixel fits
/// a.
float fittedOffset(int below, int best, int above) {
  constexpr float kLinear = 0.42f;
  const float down = static_cast<float>(below - best), up = static_cast<float>(above - best);
  const float r = std::min(down, up) / std::max(down, up);
  const float offset = 0.5f - r * (kLinear + (0.5f - kLinear) * r);
  return down < up ? -offset : offset;
}

/// One row of one view: what winner-take-all found, and how far the disparity lies from whole pixels.
struct WinnerView {
  const std::uint16_t *index, *best, *below, *above;
};

template <typename Offset>
void refineRow(const WinnerView& w, int width, const MatchOptions& o, float* disparity, Offset offset) {
  for (int x = 0; x < width; ++x) {
    const bool inner = w.index[x] > 0 && w.index[x] < o.disparities - 1;
    const float shift = inner ? offset(w.below[x], w.best[x], w.above[x]) : 0.0f;
    disparity[x] = static_cast<float>(o.min_disparity + w.index[x]) + shift;
  }
}

void refineRow(const WinnerView& w, int width, const MatchOptions& o, float* disparity) {
  switch (o.winner.subpixel) {
    case SubpixelMethod::kNone:
      return refineRow(w, width, o, disparity, [](int, int, int) { return 0.0f; });
    case SubpixelMethod::kParabola:
      return refineRow(w, width, o, disparity, parabolaOffset);
    case SubpixelMethod::kEquiangular:
      return refineRow(w, width, o, disparity, equiangularOffset);
    case SubpixelMethod::kFitted:
      return refineRow(w, width, o, disparity, fittedOffset);
  }
}

void finishRow(const WinnerMaps& w, int y, const MatchOptions& o, MatchMaps& out) {
  const int width = w.index.width();
  refineRow({w.index.row(y), w.best.row(y), w.below.row(y), w.above.row(y)}, width, o, out.disparity.row(y));
  float* right_disparity = out.right_disparity.row(y);
  const std::uint16_t* right_index = w.right_index.row(y);
  refineRow({right_index, w.right_best.row(y), w.right_below.row(y), w.right_above.row(y)}, width, o,
            right_disparity);

  const float per_path = 1.0f / static_cast<float>(o.aggregation.paths);
  const int keep_percent = 100 - o.winner.uniqueness_percent;
  const std::uint16_t *best = w.best.row(y), *second = w.second.row(y);
  for (int x = 0; x < width; ++x) {
    const bool unique = o.winner.uniqueness_percent == 0 || 100 * best[x] <= keep_percent * second[x];
    out.margin.row(y)[x] = static_cast<float>(std::max(0, second[x] - best[x])) * per_path;
    out.state.row(y)[x] = static_cast<std::uint8_t>(unique ? PixelState::kMeasured : PixelState::kAmbiguous);
    if (right_index[x] == kNoIndex) right_disparity[x] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

void MatchMaps::resize(int width, int height) {
  disparity.resize(width, height);
  right_disparity.resize(width, height);
  margin.resize(width, height);
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

void SgmMatcher::match(const MatchInput& pair, const MatchOptions& options,
                       std::span<const std::uint8_t> table, const SgmKernels& kernels, MatchMaps& out,
                       int threads) {
  const MatchingCost kind = options.cost.cost;
  const int width = pair.left.width, height = pair.left.height;
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
  aggregator_.run(cost_, steps_, options.aggregation, kernels, winners_, threads);

  out.resize(width, height);
  parallelStrips(threads, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) finishRow(winners_, y, options, out);
  });
}

}  // namespace pomona
