// Holes filled row by row, each with the plane of its colour segment.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "pyramid/kernels.h"
#include "pyramid/segment_cells.h"
#include "pyramid/view_border.h"

namespace pomona {

/// What planes may not contradict; everything has the size of the left image.
struct PlaneLimits {
  ImageView<const float> right_disparity;
  float min_disparity, max_disparity;
};

/// Works along rows, not along segments: both maps are then read as they lie in memory.
class PlaneRows {
 public:
  PlaneRows(const PlaneLimits& limits, SegmentCells& cells, const ViewBorder& border,
            ImageView<float> disparity, ImageView<std::uint8_t> state, const PyramidKernels& kernels)
      : limits_(limits),
        cells_(cells),
        border_(border),
        disparity_(disparity),
        state_(state),
        kernels_(kernels) {}

  /// Fills what the planes suit of one row of cells, and takes it off the cells' holes. `labels`: the segment
  /// of every cell, row by row.
  void fill(int cell_row, const SegmentPlane* planes, const std::int32_t* labels);

  /// The holes of row y beyond the border of the right view that share a segment with the source there take
  /// its disparity.
  void continueLevel(int y, const std::int32_t* labels);

 private:
  struct Batch;
  void fillChunk(int cell_row, int begin, int end, const SegmentPlane* planes, const std::int32_t* labels);
  void fillBatch(const PlaneFillRow& row, int cell_row, Batch& batch);
  void continueLevel(int y, int begin, int end, const ViewBorder::Source& source, const std::int32_t* labels);

  const PlaneLimits& limits_;
  SegmentCells& cells_;
  const ViewBorder& border_;
  ImageView<float> disparity_;
  ImageView<std::uint8_t> state_;
  const PyramidKernels& kernels_;
};

}  // namespace pomona
