// Matching cost of a rectified pair, produced row by row: the cost volume is never stored.
#pragma once

#include <cstdint>
#include <span>

#include "core/image.h"
#include "sgm/census.h"
#include "sgm/kernels.h"

namespace pomona {

/// The searched disparities and how the kernels lay them out.
struct DisparityRange {
  int min_disparity = 0;
  int disparities = 64;
  int vectors = 4;  ///< byte vectors per pixel
  int vector_bytes = 16;

  int lanes() const { return vectors * vector_bytes; }
};
DisparityRange makeRange(int min_disparity, int disparities, const SgmKernels& kernels);

/// Features of both views, laid out for the kernels. cost(p, d) compares left(x, y) with right(x - d, y);
/// columns beyond the right image are those of its border.
class MatchingCostRows {
 public:
  /// Census: Hamming distance of the codes, 0 .. number of bits.
  void prepareCensus(const CensusPlanes& left, const CensusPlanes& right, int maximum_cost,
                     const DisparityRange& range, const SgmKernels& kernels, int threads);
  /// table[256 * left + right] is the cost of a pair of gray values, 0 .. maximum_cost.
  void prepareTable(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                    std::span<const std::uint8_t, 65536> table, int maximum_cost, const DisparityRange& range,
                    const SgmKernels& kernels, int threads);

  int width() const { return width_; }
  int height() const { return height_; }
  const DisparityRange& range() const { return range_; }

  /// Costs of row y in striped order: width * range().lanes() bytes on a 64-byte boundary.
  void row(int y, std::uint8_t* cost) const;

 private:
  void layOut(int width, int height, int planes, int maximum_cost, const DisparityRange& range);
  void stripeRow(const std::uint8_t* right, int y, int plane);
  StripedRow striped(int y) const;

  int width_ = 0, height_ = 0, planes_ = 0;
  DisparityRange range_;
  const SgmKernels* kernels_ = nullptr;
  const CensusPlanes* left_codes_ = nullptr;  // census
  ImageView<const std::uint8_t> left_gray_;   // table
  Buffer<std::uint8_t> table_;
  Buffer<std::uint8_t> padding_;
  Buffer<std::uint8_t> striped_;  // every row of the right view, every plane, every phase
  std::ptrdiff_t phase_stride_ = 0, plane_stride_ = 0, row_stride_ = 0;
};

}  // namespace pomona
