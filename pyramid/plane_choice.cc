#include "pyramid/plane_choice.h"

#include "pyramid/holes.h"

namespace pomona {
namespace {

using Cell = SegmentCells::Cell;
using Pixel = SegmentCells::Pixel;

constexpr int kMinSources = 24;
constexpr float kMinInlierRatio = 0.5f;
constexpr int kMinOpen_px = 100;           // of a segment that is matched as a whole: its holes ...
constexpr float kMinOpenShare = 0.3f;      // ... as a share of these and its sources
constexpr float kMaxMeasuredShare = 0.3f;  // of the same: its measured pixels
constexpr double kScoreTolerance = 1.5;    // deviations that a plane's score may be below the level's

}  // namespace

// Hardly any of its pixels can be measured alone. Where more can be, holes have other reasons.
bool PlaneChoice::PixelCounts::isBare() const {
  return holes >= kMinOpen_px && has(kMinOpenShare, holes) &&
         static_cast<float>(sources) < kMaxMeasuredShare * static_cast<float>(pixels);
}

bool PlaneChoice::PixelCounts::has(float share, int part) const {
  return static_cast<float>(part) >= share * static_cast<float>(sources + holes);
}

PlaneChoice::PixelCounts PlaneChoice::countPixels(const Segment& segment) const {
  PixelCounts count;
  for (const Cell c : segment.members) {
    count.pixels += cells_.width(c) * cells_.height(c);
    count.sources += cells_.sources(c);
    count.holes += cells_.holes(c);
    count.cells_with_sources += cells_.sources(c) > 0;
  }
  return count;
}

// The plane of the sources, if there are enough of them, or if the segment as a whole agrees with it; its own
// level if that stands out and explains it clearly better.
std::optional<PlaneFit> PlaneChoice::planeFor(const Segment& segment, const PixelCounts& count,
                                              float min_coverage, std::uint32_t seed) const {
  if (count.holes == 0) return {};
  std::optional<SegmentMatch::Level> level;
  if (count.isBare()) level = match_.levelOf(segment);
  std::optional<PlaneFit> fit;
  if (level || count.has(min_coverage, count.sources)) fit = planeOfSources(segment, count, seed);
  if (!level || (fit && match_.scoreOf(segment, *fit) >= level->score - kScoreTolerance * level->deviation))
    return fit;
  return PlaneFit{{0, 0, level->disparity}, count.sources, level->disparity, level->disparity};
}

std::optional<PlaneFit> PlaneChoice::planeOfSources(const Segment& segment, const PixelCounts& count,
                                                    std::uint32_t seed) const {
  if (count.sources < kMinSources) return {};
  const PlanePoints points = sample(segment, count.cells_with_sources);
  const PlaneFit fit = fitPlane(points, seed, kernels_);
  if (fit.inliers == 0 ||
      static_cast<float>(fit.inliers) < kMinInlierRatio * static_cast<float>(points.count))
    return {};
  return fit;
}

// One source of each cell that has any, or of every second, third ... of them: as many as there is room for.
PlanePoints PlaneChoice::sample(const Segment& segment, int cells_with_sources) const {
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

}  // namespace pomona
