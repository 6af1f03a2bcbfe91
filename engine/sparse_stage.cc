#include "engine/sparse_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "filters/left_right.h"
#include "filters/median.h"
#include "filters/speckle.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

/// Ambiguous pixels lose their disparity; so do those the mask excludes.
void removeRejected(MatchMaps& maps, ImageView<const std::uint8_t> mask, int threads) {
  const int width = maps.disparity.width();
  parallelStrips(threads, maps.disparity.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint8_t* state = maps.state.row(y);
      if (!mask.empty())
        for (int x = 0; x < width; ++x)
          if (mask.row(y)[x] == 0) state[x] = static_cast<std::uint8_t>(PixelState::kMasked);
      for (int x = 0; x < width; ++x)
        if (state[x] != static_cast<std::uint8_t>(PixelState::kMeasured))
          maps.disparity.row(y)[x] = std::numeric_limits<float>::quiet_NaN();
    }
  });
}

}  // namespace

void SparseStage::run(const MatchInput& pair, const Settings& s, StageClock& clock) {
  const ValidationOptions& v = s.validation;
  matcher_.match(pair, s.match, s.mutual_information, sgmKernels(s.isa), maps_, *s.scratch, s.threads);
  removeRejected(maps_, s.mask, s.threads);
  clock.lap("matching");

  if (v.left_right_px >= 0)
    leftRightCheck(maps_.disparity.view(), maps_.state.view(), maps_.right_disparity.view(), v.left_right_px,
                   s.match.min_disparity, s.match.disparities, *s.scratch, filterKernels(s.isa), s.threads);
  clock.lap("left-right check");

  if (v.speckle_size_px > 0)
    removeSpeckles(maps_.disparity.view(), maps_.state.view(), v.speckle_size_px, v.speckle_step_px,
                   *s.scratch, filterKernels(s.isa), s.threads);
  clock.lap("speckle");

  if (v.median_size > 0)
    medianFilter(maps_.disparity.view(), maps_.disparity.view(), v.median_size, filterKernels(s.isa),
                 *s.scratch, s.threads);
  clock.lap("median");
}

MatchOptions scaledOptions(const MatchOptions& full, double ratio, int width) {
  MatchOptions o = full;
  o.min_disparity = static_cast<int>(std::floor(full.min_disparity / ratio));
  const int last = static_cast<int>(std::ceil((full.min_disparity + full.disparities - 1) / ratio));
  o.disparities = std::clamp(last - o.min_disparity + 1, 1, std::min(width, kMaxDisparities));
  return o;
}

}  // namespace pomona
