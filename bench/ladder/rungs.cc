#include "bench/ladder/rungs.h"

namespace pomona {
namespace {

// clang-format off
constexpr Rung kRungs[] = {
    {"balanced", "all stages", "", [](Options&) {}},
    {"balanced", "Sobel and gray differences in the cost", "census 7x7 alone, same penalties",
     [](Options& o) { o.cost.cost = MatchingCost::kCensus7x7; }},
    {"balanced", "support", "each pixel's own cost", [](Options& o) { o.cost.support_color_step = 0; }},
    {"balanced", "penalties adapted to colour", "P2 everywhere",
     [](Options& o) { o.aggregation.adaptation = PenaltyAdaptation::kConstant; }},
    {"balanced", "no diagonal paths", "8 paths", [](Options& o) { o.aggregation.paths = 8; }},
    {"balanced", "fitted sub-pixel curve", "parabola",
     [](Options& o) { o.winner.subpixel = SubpixelMethod::kParabola; }},
    {"balanced", "fitted sub-pixel curve", "equiangular",
     [](Options& o) { o.winner.subpixel = SubpixelMethod::kEquiangular; }},
    {"balanced", "left-right check of the seeds", "every winner of a region large enough is a seed",
     [](Options& o) { o.completion.seed_left_right_px = -1; }},
    {"balanced", "strict seeds", "left-right 1 px, speckles 50 px",
     [](Options& o) {
       o.completion.seed_left_right_px = 1.0f;
       o.completion.seed_speckle_size_px = 50;
     }},
    {"balanced", "speckle filter of the seeds", "none",
     [](Options& o) { o.completion.seed_speckle_size_px = 0; }},
    {"balanced", "median 3x3 of the seeds", "none", [](Options& o) { o.validation.median_size = 0; }},
    {"balanced", "segment planes", "rays alone fill holes",
     [](Options& o) { o.completion.segment_planes = false; }},
    {"balanced", "segments of the reduced image", "segments of the full image",
     [](Options& o) { o.completion.segment_scale = 1; }},
    {"balanced", "fine segments", "coarse ones alone", [](Options& o) { o.completion.fine_segments = false; }},
    {"balanced", "weighted median", "none", [](Options& o) { o.completion.weighted_median = false; }},
    {"balanced", "median 5x5 of the dense map", "none", [](Options& o) { o.completion.median_size = 0; }},
    {"balanced", "plane refinement", "none", [](Options& o) { o.completion.plane_refinement = false; }},
    {"quality", "all stages", "", [](Options&) {}},
    {"quality", "second pass", "the first map", [](Options& o) { o.second_pass.enabled = false; }},
    {"quality", "low penalties of the second pass", "cost and penalties of the first",
     [](Options& o) {
       o.second_pass.cost = o.cost;
       o.second_pass.aggregation = o.aggregation;
     }},
    {"quality", "no diagonal paths, in both passes", "8 paths",
     [](Options& o) { o.aggregation.paths = o.second_pass.aggregation.paths = 8; }},
    {"quality", "segment planes, in both passes", "rays alone fill holes",
     [](Options& o) { o.completion.segment_planes = false; }},
    {"quality", "weighted median, in both passes", "none",
     [](Options& o) { o.completion.weighted_median = false; }},
    {"quality", "plane refinement, in both passes", "none",
     [](Options& o) { o.completion.plane_refinement = false; }},
    {"quality", "wider window of plane refinement", "radius 2",
     [](Options& o) { o.completion.refine_radius_px = 2; }},
};
// clang-format on

}  // namespace

std::span<const Rung> rungs() {
  return kRungs;
}

}  // namespace pomona
