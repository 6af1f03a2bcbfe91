#include "pyramid/plane_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>

#include "core/parallel.h"
#include "pyramid/holes.h"
#include "pyramid/plane_fit.h"
#include "pyramid/scale.h"
#include "pyramid/segment_cells.h"
#include "pyramid/segment_match.h"
#include "pyramid/segmentation.h"
#include "pyramid/view_border.h"

namespace pomona {
namespace {

using Cell = SegmentCells::Cell;
using Pixel = SegmentCells::Pixel;

constexpr int kMinSegmentsPerStrip = 8;
constexpr int kMinRowsPerStrip = 32;
constexpr int kMinSegment_px = 100;
constexpr int kMinSources = 24;
constexpr float kMinInlierRatio = 0.5f;
constexpr float kMinOpenShare = 0.3f;      // of a segment that is matched as a whole: its holes
constexpr float kMaxMeasuredShare = 0.3f;  // of the same: its measured pixels
constexpr double kScoreTolerance = 1.5;    // deviations that a plane's score may be below the level's

struct Division {
  float k;             // of the full image
  float min_coverage;  // sources per pixel of a segment
};
constexpr std::array<Division, 2> kDivisions = {{{150, 0.3f}, {1350, 0.02f}}};

class PlaneFiller {
 public:
  PlaneFiller(const PlaneFillInput& in, SegmentCells& cells, const ViewBorder& border,
              const SegmentMatch& match, ImageView<float> disparity, ImageView<std::uint8_t> state,
              const PyramidKernels& kernels)
      : in_(in),
        cells_(cells),
        border_(border),
        match_(match),
        disparity_(disparity),
        state_(state),
        kernels_(kernels) {}

  // Reads and writes pixels of the segment only: segments may be filled in any order.
  void fill(const Segment& segment, float min_coverage, std::uint32_t seed) {
    const PixelCounts count = countPixels(segment);
    if (count.holes == 0) return;
    const std::optional<PlaneFit> fit = choosePlane(segment, count, min_coverage, seed);
    if (!fit) return;
    for (const Cell c : segment.members)
      if (cells_.holes(c) > 0) fillCell(c, segment.origin(), *fit);
  }

  // The holes of a row beyond the border that share a segment with the source there.
  void continueLevel(int y, const std::int32_t* labels) {
    for (int x = 0; x < disparity_.width; ++x) {
      const ViewBorder::Source* source = border_.before(y, x);
      if (source != nullptr && isHole(disparity_.at(y, x), state_.at(y, x)) &&
          labels[cells_.indexOf({x, y})] == labels[cells_.indexOf({source->x, y})])
        fillIfPossible({x, y}, source->disparity);
    }
  }

 private:
  struct PixelCounts {
    int pixels = 0, sources = 0, holes = 0, cells_with_sources = 0;

    // Hardly any of its pixels can be measured alone. Where more can be, holes have other reasons.
    bool isBare() const {
      return holes >= kMinSegment_px && has(kMinOpenShare, holes) &&
             static_cast<float>(sources) < kMaxMeasuredShare * static_cast<float>(pixels);
    }
    bool has(float share, int part) const {
      return static_cast<float>(part) >= share * static_cast<float>(sources + holes);
    }
  };

  PixelCounts countPixels(const Segment& segment) const {
    PixelCounts count;
    for (const Cell c : segment.members) {
      count.pixels += cells_.width(c) * cells_.height(c);
      count.sources += cells_.sources(c);
      count.holes += cells_.holes(c);
      count.cells_with_sources += cells_.sources(c) > 0;
    }
    return count;
  }

  // The plane of the sources, if there are enough of them, or if the segment as a whole agrees with it; its
  // own level if that stands out and explains it clearly better.
  std::optional<PlaneFit> choosePlane(const Segment& segment, const PixelCounts& count, float min_coverage,
                                      std::uint32_t seed) const {
    std::optional<SegmentMatch::Level> level;
    if (count.isBare()) level = match_.levelOf(segment);
    std::optional<PlaneFit> fit;
    if (level || count.has(min_coverage, count.sources)) fit = planeOfSources(segment, count, seed);
    if (!level || (fit && match_.scoreOf(segment, *fit) >= level->score - kScoreTolerance * level->deviation))
      return fit;
    return PlaneFit{{0, 0, level->disparity}, count.sources, level->disparity, level->disparity};
  }

  std::optional<PlaneFit> planeOfSources(const Segment& segment, const PixelCounts& count,
                                         std::uint32_t seed) const {
    if (count.sources < kMinSources) return {};
    const PlanePoints points = sample(segment, count.cells_with_sources);
    const PlaneFit fit = fitPlane(points, seed, kernels_);
    if (fit.inliers == 0 ||
        static_cast<float>(fit.inliers) < kMinInlierRatio * static_cast<float>(points.count))
      return {};
    return fit;
  }

  // One source of each cell that has any, or of every second, third ... of them: as many as there is room
  // for.
  PlanePoints sample(const Segment& segment, int cells_with_sources) const {
    const Pixel origin = segment.origin();
    PlanePoints points;
    const int step = (cells_with_sources + PlanePoints::kCapacity - 1) / PlanePoints::kCapacity;
    int until_next = 0;
    for (const Cell c : segment.members) {
      if (cells_.sources(c) == 0 || until_next-- > 0) continue;
      until_next = step - 1;
      const Pixel p = cells_.findPixel(
          c, [this](Pixel q) { return isSource(disparity_.at(q.y, q.x), state_.at(q.y, q.x)); });
      points.add(static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y),
                 disparity_.at(p.y, p.x));
    }
    return points;
  }

  void fillCell(Cell cell, Pixel origin, const PlaneFit& fit) {
    int open = 0;
    cells_.forEachPixel(cell, [&](Pixel p) {
      if (!isHole(disparity_.at(p.y, p.x), state_.at(p.y, p.x))) return;
      const float e = fit.at(static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y));
      open += leavesBorderSource(p, origin, fit.plane) || !fillIfPossible(p, e);
    });
    cells_.setHoles(cell, open);
  }

  bool leavesBorderSource(Pixel p, Pixel origin, const DisparityPlane& plane) const {
    const ViewBorder::Source* source = border_.before(p.y, p.x);
    if (source == nullptr) return false;
    const float e = plane.at(static_cast<float>(source->x - origin.x), static_cast<float>(p.y - origin.y));
    return !(std::abs(e - source->disparity) < kPlaneTolerance_px);
  }

  bool fillIfPossible(Pixel p, float e) {
    if (!(e >= in_.min_disparity && e <= in_.max_disparity) ||
        wouldHideFromRight(in_.right_disparity, p.y, p.x, e))
      return false;
    disparity_.at(p.y, p.x) = e;
    state_.at(p.y, p.x) = static_cast<std::uint8_t>(PixelState::kFilledPlane);
    return true;
  }

  const PlaneFillInput& in_;
  SegmentCells& cells_;
  const ViewBorder& border_;
  const SegmentMatch& match_;
  ImageView<float> disparity_;
  ImageView<std::uint8_t> state_;
  const PyramidKernels& kernels_;
};

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
  parallelFor(threads, static_cast<int>(kDivisions.size()), [&](int i) {
    const float k = kDivisions[static_cast<std::size_t>(i)].k / static_cast<float>(in.scale);
    const int min_size = kMinSegment_px / (in.scale * in.scale);
    Segments& s = divisions[static_cast<std::size_t>(i)];
    s.count = segment(edges, {k, min_size}, s.labels, scratch[i]);
  });
  return divisions;
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
                static_cast<int>(in.max_disparity - in.min_disparity) + 1, kernels, scratch, threads);
  PlaneFiller filler(in, cells, border, match, disparity, state, kernels);
  for (std::size_t i = 0; i < kDivisions.size(); ++i) {
    const Segments& s = divisions[i];
    cells.group(s.labels, s.count);
    parallelStrips(threads, s.count, kMinSegmentsPerStrip, [&](int begin, int end) {
      for (int j = begin; j < end; ++j)
        filler.fill({cells.segment(j), cells, s.labels}, kDivisions[i].min_coverage,
                    static_cast<std::uint32_t>(j));
    });
  }
  parallelStrips(threads, disparity.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) filler.continueLevel(y, divisions.back().labels);
  });
}

}  // namespace pomona
