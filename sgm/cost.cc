#include "sgm/cost.h"

#include <algorithm>
#include <cstring>

#include "core/parallel.h"

namespace pomona {

DisparityRange makeRange(int min_disparity, int disparities, const SgmKernels& kernels) {
  return {min_disparity, disparities, vectorsFor(disparities, kernels.vector_bytes), kernels.vector_bytes};
}

void MatchingCostRows::layOut(int width, int height, int planes, int maximum_cost,
                              const DisparityRange& range) {
  width_ = width;
  height_ = height;
  planes_ = planes;
  range_ = range;

  padding_.resize(range.lanes());
  for (int d = 0; d < range.lanes(); ++d) {
    const int vector = d % range.vectors, lane = d / range.vectors;
    padding_[vector * range.vector_bytes + lane] =
        d < range.disparities ? 0 : static_cast<std::uint8_t>(maximum_cost);
  }

  // The last load of a phase starts at (width - 1 + vectors - 1) / vectors and takes a whole vector.
  phase_stride_ = ((width - 1) / range.vectors + 1 + range.vector_bytes + 63) / 64 * 64;
  plane_stride_ = phase_stride_ * range.vectors;
  row_stride_ = plane_stride_ * planes;
  striped_.resize(static_cast<std::size_t>(row_stride_) * height);
}

void MatchingCostRows::stripeRow(const std::uint8_t* right, int y, int plane) {
  std::uint8_t* const to = striped_.data() + y * row_stride_ + plane * plane_stride_;
  const int n = range_.vectors;
  for (int phase = 0; phase < n; ++phase) {
    std::uint8_t* out = to + phase * phase_stride_;
    // Byte m stands for column c - m * n. Columns right of the image come first, columns left of it last.
    const int c = width_ - 1 - range_.min_disparity - phase, length = static_cast<int>(phase_stride_);
    const int first_inside = std::clamp(c <= width_ - 1 ? 0 : (c - width_ + n) / n, 0, length);
    const int first_beyond = std::clamp(c < 0 ? 0 : c / n + 1, first_inside, length);
    std::memset(out, right[width_ - 1], first_inside);
    for (int m = first_inside; m < first_beyond; ++m) out[m] = right[c - m * n];
    std::memset(out + first_beyond, right[0], length - first_beyond);
  }
}

StripedRow MatchingCostRows::striped(int y) const {
  return {striped_.data() + y * row_stride_, phase_stride_, plane_stride_};
}

void MatchingCostRows::prepareCensus(const CensusPlanes& left, const CensusPlanes& right, int maximum_cost,
                                     const DisparityRange& range, const SgmKernels& kernels, int threads) {
  layOut(left.plane[0].width(), left.plane[0].height(), left.planes, maximum_cost, range);
  kernels_ = &kernels;
  left_codes_ = &left;
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int p = 0; p < planes_; ++p) stripeRow(right.plane[p].row(y), y, p);
  });
}

void MatchingCostRows::prepareTable(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                                    std::span<const std::uint8_t, 65536> table, int maximum_cost,
                                    const DisparityRange& range, const SgmKernels& kernels, int threads) {
  layOut(left.width, left.height, 1, maximum_cost, range);
  kernels_ = &kernels;
  left_codes_ = nullptr;
  left_gray_ = left;
  table_.resize(table.size());
  std::copy(table.begin(), table.end(), table_.data());
  parallelStrips(threads, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) stripeRow(right.row(y), y, 0);
  });
}

void MatchingCostRows::row(int y, std::uint8_t* cost) const {
  if (left_codes_) {
    CensusCostRow r{width_, range_.vectors, planes_, {}, striped(y), padding_.data(), cost};
    for (int p = 0; p < planes_; ++p) r.left[p] = left_codes_->plane[p].row(y);
    kernels_->censusCost(r);
  } else {
    kernels_->tableCost(
        {width_, range_.vectors, left_gray_.row(y), striped(y), table_.data(), padding_.data(), cost});
  }
}

}  // namespace pomona
