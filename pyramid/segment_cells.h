// The full image's pixels by colour segment of a reduced one.
#pragma once

#include <cstdint>
#include <span>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

/// The image in blocks, one cell for each pixel of the reduced image: pixel x belongs to column
/// floor(x columns / width), and rows likewise. Cells know how many sources and holes (see holes.h) they
/// hold, and can be listed by segment.
class SegmentCells {
 public:
  struct Cell {
    std::uint16_t x, y;
  };
  struct Pixel {
    int x, y;
  };

  /// A cell has at most 16 pixels; there are at most 65535 columns and rows. Everything lies in the current
  /// scope of `arena`, group()'s part as well.
  void count(ImageView<const float> disparity, ImageView<const std::uint8_t> state, int columns, int rows,
             const PyramidKernels& kernels, Arena& arena, int threads);
  /// Lists the cells by label; `labels` holds values below `segments`, row by row.
  void group(const std::int32_t* labels, int segments);

  std::span<const Cell> segment(int i) const {
    return {cells_ + segment_begin_[i], cells_ + segment_begin_[i + 1]};
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int width(Cell c) const { return column_begin_[c.x + 1] - column_begin_[c.x]; }
  int height(Cell c) const { return row_begin_[c.y + 1] - row_begin_[c.y]; }
  int sources(Cell c) const { return sources_[index(c)]; }
  int holes(Cell c) const { return holes_[index(c)]; }
  void takeHole(Cell c) { --holes_[index(c)]; }
  /// Place of the pixel's cell among the labels.
  std::size_t indexOf(Pixel p) const {
    return index({static_cast<std::uint16_t>(std::int64_t{p.x} * columns_ / column_begin_[columns_]),
                  static_cast<std::uint16_t>(std::int64_t{p.y} * rows_ / row_begin_[rows_])});
  }
  Pixel firstPixel(Cell c) const { return {column_begin_[c.x], row_begin_[c.y]}; }

  /// The first pixel, row by row, for which is_wanted(pixel); there must be one.
  template <typename F>
  Pixel findPixel(Cell c, F is_wanted) const {
    Pixel p = firstPixel(c);
    while (!is_wanted(p))
      if (++p.x == column_begin_[c.x + 1]) p = {column_begin_[c.x], p.y + 1};
    return p;
  }
  template <typename F>
  void forEachPixel(Cell c, F visit) const {
    const int *x_range = column_begin_ + c.x, *y_range = row_begin_ + c.y;
    for (int y = y_range[0]; y < y_range[1]; ++y)
      for (int x = x_range[0]; x < x_range[1]; ++x) visit(Pixel{x, y});
  }

 private:
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(columns_) + c.x;
  }
  void countRow(int row, ImageView<const float> disparity, ImageView<const std::uint8_t> state,
                const PyramidKernels& kernels, std::uint16_t* sums);

  int columns_ = 0, rows_ = 0;
  int *column_begin_ = nullptr, *row_begin_ = nullptr;  // the first pixel of each, and of what would follow
  std::uint8_t *sources_ = nullptr, *holes_ = nullptr;  // in each cell
  Cell* cells_ = nullptr;                               // segment after segment
  int* segment_begin_ = nullptr;
};

}  // namespace pomona
