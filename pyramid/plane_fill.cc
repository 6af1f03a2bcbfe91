#include "pyramid/plane_fill.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>

#include "core/parallel.h"
#include "pyramid/plane_choice.h"
#include "pyramid/plane_rows.h"
#include "pyramid/scale.h"
#include "pyramid/segment_cells.h"
#include "pyramid/segment_match.h"
#include "pyramid/segmentation.h"
#include "pyramid/view_border.h"

namespace pomona {
namespace {

constexpr int kMinSegmentsPerStrip = 8;
constexpr int kMinRowsPerStrip = 32;
constexpr int kMinCellRowsPerStrip = 8;
constexpr int kMinSegment_px = 100;

struct Division {
  float k;             // of the full image
  float min_coverage;  // sources per pixel of a segment
};
constexpr std::array<Division, 2> kDivisions = {{{150, 0.3f}, {1350, 0.02f}}};

std::size_t firstDivision(const PlaneFillInput& in) {
  return in.fine ? 0 : 1;
}

struct Segments {
  std::int32_t* labels;
  int count;
};
using Divisions = std::array<Segments, kDivisions.size()>;

Divisions divide(const PlaneFillInput& in, int columns, int rows, Arena& arena, const PyramidKernels& kernels,
                 int threads) {
  const std::size_t pixels = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  Divisions divisions;
  for (Segments& s : divisions) s.labels = arena.take<std::int32_t>(pixels);

  const Arena::Scope scope(arena);
  GuideView guide = in.guide;
  if (in.scale > 1) {
    const auto reduced = arena.image<std::uint8_t>(columns * guide.channels, rows);
    areaDownscale(in.guide, reduced, arena, kernels, threads);
    guide = {reduced.data, columns, rows, guide.channels, reduced.stride};
  }
  SortedEdges edges;
  edges.build(guide, kernels, arena, threads);
  const SegmentationScratch scratch[] = {SegmentationScratch(edges, arena),
                                         SegmentationScratch(edges, arena)};
  static_assert(std::size(scratch) == kDivisions.size());
  const std::size_t first = firstDivision(in);
  parallelFor(threads, static_cast<int>(kDivisions.size() - first), [&](int task) {
    const std::size_t i = first + static_cast<std::size_t>(task);
    const float k = kDivisions[i].k / static_cast<float>(in.scale);
    const int min_size = kMinSegment_px / (in.scale * in.scale);
    divisions[i].count = segment(edges, {k, min_size}, divisions[i].labels, scratch[i]);
  });
  return divisions;
}

SegmentPlane planeAt(SegmentCells::Pixel origin, const std::optional<PlaneFit>& fit) {
  if (!fit) {
    SegmentPlane none;
    none.c = std::numeric_limits<float>::quiet_NaN();
    return none;
  }
  const auto& [a, b, c] = fit->plane;
  return {a, b, c, fit->low - kPlaneTolerance_px, fit->high + kPlaneTolerance_px, origin.x, origin.y, 0};
}

}  // namespace

void fillFromPlanes(const PlaneFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
                    Arena& scratch, const PyramidKernels& kernels, int threads) {
  const int columns = scaledLength(disparity.width, in.scale);
  const int rows = scaledLength(disparity.height, in.scale);
  const Arena::Scope scope(scratch);
  SegmentCells cells;
  cells.count(disparity, state, columns, rows, kernels, scratch, threads);
  const Divisions divisions = divide(in, columns, rows, scratch, kernels, threads);
  ViewBorder border;
  border.find(disparity, state, scratch, threads);
  SegmentMatch match;
  match.prepare(in.left, in.right, static_cast<int>(in.min_disparity),
                static_cast<int>(in.max_disparity - in.min_disparity) + 1, kernels, scratch);
  const PlaneChoice choice(cells, match, disparity, state, kernels);
  const PlaneLimits limits{in.right_disparity, in.min_disparity, in.max_disparity};
  PlaneRows filler(limits, cells, border, disparity, state, kernels);
  const std::size_t most_segments = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  SegmentPlane* const planes = scratch.take<SegmentPlane>(most_segments);
  auto* const counts = scratch.take<PlaneChoice::PixelCounts>(most_segments);
  for (std::size_t i = firstDivision(in); i < kDivisions.size(); ++i) {
    const Segments& s = divisions[i];
    cells.group(s.labels, s.count);
    const auto segmentAt = [&](int j) { return Segment{cells.segment(j), cells, s.labels}; };
    parallelStrips(threads, s.count, kMinSegmentsPerStrip, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) counts[j] = choice.countPixels(segmentAt(j));
    });
    for (int j = 0; j < s.count; ++j)
      if (counts[j].isBare()) match.announce(segmentAt(j));
    match.readAnnounced(threads);
    parallelStrips(threads, s.count, kMinSegmentsPerStrip, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Segment segment = segmentAt(j);
        planes[j] = planeAt(segment.origin(), choice.planeFor(segment, counts[j], kDivisions[i].min_coverage,
                                                              static_cast<std::uint32_t>(j)));
      }
    });
    parallelStrips(threads, rows, kMinCellRowsPerStrip, [&](int begin, int end) {
      for (int row = begin; row < end; ++row) filler.fill(row, planes, s.labels);
    });
  }
  parallelStrips(threads, disparity.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) filler.continueLevel(y, divisions.back().labels);
  });
}

}  // namespace pomona
