#include "engine/completion_stage.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/parallel.h"
#include "engine/refinement.h"
#include "pomona/pixel_state.h"
#include "pyramid/hole_fill.h"
#include "pyramid/plane_fill.h"
#include "pyramid/segment_match.h"

namespace pomona {
namespace {

static_assert(SegmentMatch::kMostDisparities >= kMaxDisparities);

struct Limits {
  float low, high;
  explicit Limits(const MatchOptions& match)
      : low(static_cast<float>(match.min_disparity)),
        high(static_cast<float>(match.min_disparity + match.disparities - 1)) {}
};

/// Coarse maps and fitted planes may overshoot.
void clampTo(Limits limits, Image<float>& disparity, int threads) {
  parallelStrips(threads, disparity.height(), 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < disparity.width(); ++x) {
        float& d = disparity.row(y)[x];
        d = d < limits.low ? limits.low : d > limits.high ? limits.high : d;  // NaN stays
      }
  });
}

}  // namespace

void CompletionStage::run(const MatchInput& pair, const SparseStage::Settings& settings,
                          const CompletionOptions& options, MatchMaps& maps, StageClock& clock) {
  if (options.method == CompletionMethod::kPaper) {
    takeCoarse(pair, settings, options, maps);
    clampTo(Limits(settings.match), maps.disparity, settings.threads);
    clock.lap("coarse maps");
  } else {
    fillHolesOf(pair, settings, options, maps, clock);
  }
}

/// The paper's dense map: every pixel from the coarse scales.
void CompletionStage::takeCoarse(const MatchInput& pair, const SparseStage::Settings& settings,
                                 const CompletionOptions& options, MatchMaps& maps) {
  maps.resize(pair.left.width, pair.left.height);
  const Arena::Scope scope(*settings.scratch);
  const ImageView<const float> map = coarse_.run(pair, settings, options);
  const float lowest = Limits(settings.match).low;
  parallelStrips(settings.threads, map.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < map.width; ++x) {
        const bool masked = !settings.mask.empty() && settings.mask.at(y, x) == 0;
        const float d = map.at(y, x);
        maps.state.row(y)[x] =
            static_cast<std::uint8_t>(masked ? PixelState::kMasked : PixelState::kFilledCoarse);
        maps.disparity.row(y)[x] = masked          ? std::numeric_limits<float>::quiet_NaN()
                                   : std::isnan(d) ? lowest
                                                   : d;
      }
  });
}

void CompletionStage::fillHolesOf(const MatchInput& pair, const SparseStage::Settings& settings,
                                  const CompletionOptions& options, MatchMaps& maps, StageClock& clock) {
  const Limits limits(settings.match);
  const PyramidKernels& kernels = pyramidKernels(settings.isa);
  if (options.segment_planes)
    fillFromPlanes({.guide = pair.guide,
                    .left = pair.left,
                    .right = pair.right,
                    .right_disparity = maps.right_disparity.view(),
                    .scale = options.segment_scale,
                    .fine = options.fine_segments,
                    .min_disparity = limits.low,
                    .max_disparity = limits.high},
                   maps.disparity.view(), maps.state.view(), *settings.scratch, kernels, settings.threads);
  clock.lap("segment planes");
  bool may_overshoot = options.plane_refinement;
  const auto coarse_map = [&] {
    may_overshoot = true;
    return coarse_.run(pair, settings, options);
  };
  fillHoles({.guide = pair.guide,
             .right_disparity = maps.right_disparity.view(),
             .coarse = coarse_map,
             .search_radius_px = options.search_radius_px,
             .fallback_disparity = limits.low},
            maps.disparity.view(), maps.state.view(), *settings.scratch, kernels, settings.threads);
  clock.lap("hole filling");
  refine(maps.disparity.view(), pair.guide, options, filterKernels(settings.isa), *settings.scratch,
         settings.threads, clock);
  if (may_overshoot) clampTo(limits, maps.disparity, settings.threads);
}

}  // namespace pomona
