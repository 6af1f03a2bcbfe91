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

template <typename Offset>
void refineRow(const WinnerMaps& w, int y, int width, const MatchOptions& o, float* disparity,
               Offset offset) {
  const std::uint16_t *index = w.index.row(y), *best = w.best.row(y), *below = w.below.row(y),
                      *above = w.above.row(y);
  for (int x = 0; x < width; ++x) {
    const bool inner = index[x] > 0 && index[x] < o.disparities - 1;
    const float shift = inner ? offset(below[x], best[x], above[x]) : 0.0f;
    disparity[x] = static_cast<float>(o.min_disparity + index[x]) + shift;
  }
}

void finishRow(const WinnerMaps& w, int y, const MatchOptions& o, MatchMaps& out) {
  const int width = w.index.width();
  float* disparity = out.disparity.row(y);
  switch (o.winner.subpixel) {
    case SubpixelMethod::kNone:
      refineRow(w, y, width, o, disparity, [](int, int, int) { return 0.0f; });
      break;
    case SubpixelMethod::kParabola:
      refineRow(w, y, width, o, disparity, parabolaOffset);
      break;
    case SubpixelMethod::kEquiangular:
      refineRow(w, y, width, o, disparity, equiangularOffset);
      break;
  }

  const float per_path = 1.0f / static_cast<float>(o.aggregation.paths);
  const int keep_percent = 100 - o.winner.uniqueness_percent;
  const std::uint16_t *best = w.best.row(y), *second = w.second.row(y), *right = w.right_index.row(y);
  for (int x = 0; x < width; ++x) {
    const bool unique = 100 * best[x] <= keep_percent * second[x];
    out.margin.row(y)[x] = static_cast<float>(std::max(0, second[x] - best[x])) * per_path;
    out.state.row(y)[x] = static_cast<std::uint8_t>(
        unique || o.winner.uniqueness_percent == 0 ? PixelState::kMeasured : PixelState::kAmbiguous);
    out.right_disparity.row(y)[x] = right[x] == kNoIndex ? std::numeric_limits<float>::quiet_NaN()
                                                         : static_cast<float>(o.min_disparity + right[x]);
  }
}

}  // namespace

void SgmMatcher::match(const GrayPair& pair, const MatchOptions& options, std::span<const std::uint8_t> table,
                       const SgmKernels& kernels, MatchMaps& out, int threads) {
  const MatchingCost kind = options.cost.cost;
  const int width = pair.left.width, height = pair.left.height;
  const DisparityRange range = makeRange(options.min_disparity, options.disparities, kernels);

  if (kind == MatchingCost::kMutualInformation) {
    cost_.prepareTable(pair.left, pair.right, table.first<65536>(), maximumCost(kind), range, kernels,
                       threads);
  } else {
    if (pair.isDeep()) {
      census16_.compute(pair.left16, kind, left_codes_, kernels, threads);
      census16_.compute(pair.right16, kind, right_codes_, kernels, threads);
    } else {
      census_.compute(pair.left, kind, left_codes_, kernels, threads);
      census_.compute(pair.right, kind, right_codes_, kernels, threads);
    }
    cost_.prepareCensus(left_codes_, right_codes_, maximumCost(kind), range, kernels, threads);
  }
  aggregator_.run(cost_, pair.left, options.aggregation, kernels, winners_, threads);

  out.disparity.resize(width, height);
  out.right_disparity.resize(width, height);
  out.margin.resize(width, height);
  out.state.resize(width, height);
  parallelStrips(threads, height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) finishRow(winners_, y, options, out);
  });
}

}  // namespace pomona
