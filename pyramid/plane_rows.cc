#include "pyramid/plane_rows.h"

#include <algorithm>
#include <cmath>

#include "pyramid/holes.h"
#include "pyramid/plane_fit.h"

namespace pomona {
namespace {

constexpr std::uint8_t kFilled = static_cast<std::uint8_t>(PixelState::kFilledPlane);
constexpr int kMostCellColumns = 4;  // of a cell, see SegmentCells
constexpr int kCellChunk = 512;

}  // namespace

/// Holes of a row: places past the last one hold valid ones, too.
struct PlaneRows::Batch {
  std::int32_t x[kPlaneBatch] = {}, segment[kPlaneBatch] = {};
  std::uint16_t column[kPlaneBatch];  // of the cell
  int count = 0;
};

void PlaneRows::fillBatch(const PlaneFillRow& row, int cell_row, Batch& batch) {
  float filled[kPlaneBatch];
  kernels_.planeDisparities(row, batch.x, batch.segment, batch.count, filled);
  float* const disparity = disparity_.row(row.y);
  std::uint8_t* const state = state_.row(row.y);
  for (int i = 0; i < batch.count; ++i) {
    if (std::isnan(filled[i])) continue;
    disparity[batch.x[i]] = filled[i];
    state[batch.x[i]] = kFilled;
    cells_.takeHole({batch.column[i], static_cast<std::uint16_t>(cell_row)});
  }
  batch.count = 0;
}

void PlaneRows::fill(int cell_row, const SegmentPlane* planes, const std::int32_t* labels) {
  for (int column = 0; column < cells_.columns(); column += kCellChunk)
    fillChunk(cell_row, column, std::min(cells_.columns(), column + kCellChunk), planes, labels);
}

// Cells are looked through once, not once for each of their rows: most have no holes.
void PlaneRows::fillChunk(int cell_row, int begin, int end, const SegmentPlane* planes,
                          const std::int32_t* labels) {
  const auto cellAt = [&](int column) {
    return SegmentCells::Cell{static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(cell_row)};
  };
  const std::int32_t* const label = labels + static_cast<std::ptrdiff_t>(cell_row) * cells_.columns();
  int open[kCellChunk], open_count = 0;
  for (int column = begin; column < end; ++column) {
    open[open_count] = column;
    open_count += (cells_.holes(cellAt(column)) != 0) & !std::isnan(planes[label[column]].c);
  }
  if (open_count == 0) return;
  const int first_y = cells_.firstPixel(cellAt(0)).y, height = cells_.height(cellAt(0));
  Batch batch;
  for (int y = first_y; y < first_y + height; ++y) {
    const float* const disparity = disparity_.row(y);
    const std::uint8_t* const state = state_.row(y);
    const ViewBorder::Ends& ends = border_.ends(y);
    const PlaneFillRow row{.planes = planes,
                           .right_disparity = limits_.right_disparity.row(y),
                           .width = disparity_.width,
                           .y = y,
                           .min_disparity = limits_.min_disparity,
                           .max_disparity = limits_.max_disparity,
                           .visibility_tolerance_px = kVisibilityTolerance_px,
                           .border_tolerance_px = kPlaneTolerance_px,
                           .left_x = ends.left.x,
                           .right_x = ends.right.x,
                           .beyond_left_px = ends.left.disparity,
                           .beyond_right_px = ends.right.disparity};
    for (int i = 0; i < open_count; ++i) {
      const int column = open[i];
      const SegmentCells::Cell cell = cellAt(column);
      const int first_x = cells_.firstPixel(cell).x;
      for (int x = first_x; x < first_x + cells_.width(cell); ++x) {
        batch.x[batch.count] = x;
        batch.segment[batch.count] = label[column];
        batch.column[batch.count] = cell.x;
        batch.count += isHole(disparity[x], state[x]);
      }
      if (batch.count > kPlaneBatch - kMostCellColumns - 1) fillBatch(row, cell_row, batch);
    }
    fillBatch(row, cell_row, batch);
  }
}

void PlaneRows::continueLevel(int y, const std::int32_t* labels) {
  const ViewBorder::Ends& ends = border_.ends(y);
  continueLevel(y, 0, ends.left.x, ends.left, labels);
  continueLevel(y, ends.right.x + 1, disparity_.width, ends.right, labels);
}

void PlaneRows::continueLevel(int y, int begin, int end, const ViewBorder::Source& source,
                              const std::int32_t* labels) {
  for (int x = begin; x < end; ++x) {
    const float d = source.disparity;
    if (!isHole(disparity_.at(y, x), state_.at(y, x)) ||
        labels[cells_.indexOf({x, y})] != labels[cells_.indexOf({source.x, y})] ||
        !(d >= limits_.min_disparity && d <= limits_.max_disparity) ||
        wouldHideFromRight(limits_.right_disparity, y, x, d))
      continue;
    disparity_.at(y, x) = d;
    state_.at(y, x) = kFilled;
  }
}

}  // namespace pomona
