// Which plane the holes of a colour segment take.
#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "pyramid/kernels.h"
#include "pyramid/plane_fit.h"
#include "pyramid/segment_cells.h"
#include "pyramid/segment_match.h"

namespace pomona {

/// Chooses from what is measured, see fillFromPlanes(). What was filled meanwhile does not count.
class PlaneChoice {
 public:
  PlaneChoice(const SegmentCells& cells, const SegmentMatch& match, ImageView<const float> disparity,
              ImageView<const std::uint8_t> state, const PyramidKernels& kernels)
      : cells_(cells), match_(match), disparity_(disparity), state_(state), kernels_(kernels) {}

  /// Of a segment.
  struct PixelCounts {
    int pixels = 0, sources = 0, holes = 0, cells_with_sources = 0;

    bool isBare() const;  ///< then it is matched as a whole
    bool has(float share, int part) const;
  };
  PixelCounts countPixels(const Segment& segment) const;

  /// A fit relative to the segment's origin; none if the segment has no holes, or if nothing suits them.
  /// `min_coverage`: sources per source or hole of a segment that is not matched as a whole.
  std::optional<PlaneFit> planeFor(const Segment& segment, const PixelCounts& count, float min_coverage,
                                   std::uint32_t seed) const;

 private:
  std::optional<PlaneFit> planeOfSources(const Segment& segment, const PixelCounts& count,
                                         std::uint32_t seed) const;
  PlanePoints sample(const Segment& segment, int cells_with_sources) const;

  const SegmentCells& cells_;
  const SegmentMatch& match_;
  ImageView<const float> disparity_;
  ImageView<const std::uint8_t> state_;
  const PyramidKernels& kernels_;
};

}  // namespace pomona
