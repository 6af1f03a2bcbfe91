#include "pyramid/segment_cells.h"

#include <algorithm>

#include "core/parallel.h"
#include "pyramid/hole_states.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 16;

// The first of `pixels` that belongs to each of `cells`.
int* cut(int pixels, int cells, Arena& arena) {
  int* const begin = arena.take<int>(static_cast<std::size_t>(cells) + 1);
  for (int i = 0; i <= cells; ++i)
    begin[i] = static_cast<int>((std::int64_t{i} * pixels + cells - 1) / cells);
  return begin;
}

}  // namespace

void SegmentCells::count(ImageView<const float> disparity, ImageView<const std::uint8_t> state, int columns,
                         int rows, const PyramidKernels& kernels, Arena& arena, int threads) {
  columns_ = columns;
  rows_ = rows;
  column_begin_ = cut(disparity.width, columns, arena);
  row_begin_ = cut(disparity.height, rows, arena);
  const std::size_t cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  sources_ = arena.take<std::uint8_t>(cells);
  holes_ = arena.take<std::uint8_t>(cells);
  cells_ = arena.take<Cell>(cells);
  segment_begin_ = arena.take<int>(cells + 2);  // enough for any number of segments
  const Arena::Scope scope(arena);
  const auto column_sums = arena.image<std::uint16_t>(disparity.width, rows);
  parallelStrips(threads, rows, kMinRowsPerStrip, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) countRow(i, disparity, state, kernels, column_sums.row(i));
  });
}

void SegmentCells::countRow(int row, ImageView<const float> disparity, ImageView<const std::uint8_t> state,
                            const PyramidKernels& kernels, std::uint16_t* sums) {
  std::fill_n(sums, disparity.width, std::uint16_t{0});
  for (int y = row_begin_[row]; y < row_begin_[row + 1]; ++y)
    kernels.countSourcesAndHoles(disparity.row(y), state.row(y), kHoleStates, disparity.width, sums);
  const std::size_t first = index({0, static_cast<std::uint16_t>(row)});
  for (int i = 0; i < columns_; ++i) {
    int sum = 0;
    for (int x = column_begin_[i]; x < column_begin_[i + 1]; ++x) sum += sums[x];
    sources_[first + i] = static_cast<std::uint8_t>(sum % 256);
    holes_[first + i] = static_cast<std::uint8_t>(sum / 256);
  }
}

void SegmentCells::group(const std::int32_t* labels, int segments) {
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  int* next = segment_begin_ + 1;
  std::fill_n(segment_begin_, segments + 2, 0);
  for (std::size_t i = 0; i < cells; ++i) ++next[labels[i] + 1];
  for (int i = 0; i < segments; ++i) next[i + 1] += next[i];
  std::size_t i = 0;
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      cells_[next[labels[i++]]++] = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
}

}  // namespace pomona
