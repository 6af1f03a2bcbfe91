// Winner-take-all for both views, pixel after pixel from right to left.
#pragma once

#include "sgm/kernels.h"
#include "sgm/kernels/dispatch.inl"

namespace {

template <int kCapacityVectors>
class Winner {
 public:
  Winner(const pomona::WinnerRow& row, int vectors, int width) : row_(row), vectors_(vectors), width_(width) {
    for (int k = 0; k < 2 * vectors; ++k) {
      right_best_[k] = simd::broadcast16(0xFFFF);
      right_label_[k] = simd::broadcast16(pomona::kNoIndex);
    }
  }

  /// `sums`: the pixel's 2 * vectors word vectors. x falls by one from call to call.
  template <int kVectors>
  POMONA_OP void pixel(int x, simd::U16* sums) {
    const int n = kVectors ? kVectors : vectors_;
    std::uint16_t* memory = sumsOf(x, n);
    simd::U16 smallest = simd::broadcast16(0xFFFF);
    for (int k = 0; k < 2 * n; ++k) {
      if (row_.padded) sums[k] = simd::or16(sums[k], simd::load16(row_.padding + k * kWords));
      simd::store16(memory + k * kWords, sums[k]);
      smallest = simd::min16(smallest, sums[k]);
    }
    const simd::U16 best = simd::minimum16(smallest);
    int index = pomona::kMaxDisparities;
    for (int j = 0; j < n; ++j) {
      const std::uint64_t lanes = simd::equalLanes(sums[2 * j], sums[2 * j + 1], best);
      const int d = n * (lanes ? __builtin_ctzll(lanes) : pomona::kMaxDisparities) + j;
      index = d < index ? d : index;
    }
    const simd::U16 first_near = simd::broadcast16(static_cast<std::uint16_t>(index - 1));
    simd::U16 second = simd::broadcast16(0xFFFF);
    // Right pixel q sees the sums S(q + d, d). The lanes hold the candidates of the pixels x - d: pixel x
    // adds its own, then the right pixel of disparity index 0 is complete and every lane moves on by one
    // disparity.
    for (int k = 0; k < 2 * n; ++k) {
      const simd::U16 label = simd::load16(row_.labels + k * kWords);
      second = simd::minimumAway(second, sums[k], label, first_near);
      simd::keepSmaller(right_best_[k], right_label_[k], sums[k], label);
    }
    row_.index[x] = static_cast<std::uint16_t>(index);
    row_.best[x] = simd::first16(best);
    row_.below[x] = memory[row_.position[index - 1]];
    row_.above[x] = memory[row_.position[index + 1]];
    row_.second[x] = simd::first16(simd::minimum16(second));
    emitRight<kVectors>(x);
  }

  /// Call after pixel 0. With negative disparities the rightmost columns to come still have candidates.
  template <int kVectors>
  void finish() {
    for (int x = -1; x - row_.min_disparity >= 0; --x) emitRight<kVectors>(x);
  }

 private:
  static constexpr int kWords = simd::kBytes / 2;

  POMONA_OP std::uint16_t* sumsOf(int x, int vectors) const {
    return row_.recent + static_cast<std::ptrdiff_t>(x & row_.recent_mask) * (2 * vectors * kWords);
  }

  template <int kVectors>
  POMONA_OP void emitRight(int x) {
    const int n = kVectors ? kVectors : vectors_;
    const int q = x - row_.min_disparity;
    if (q >= 0 && q < width_)
      writeRight(q, x, simd::first16(right_best_[0]), simd::first16(right_label_[0]), n);
    advance<kVectors>(right_best_, n);
    advance<kVectors>(right_label_, n);
  }

  template <int kVectors>
  POMONA_OP static void advance(simd::U16* v, int n) {
    simd::U16 low = v[0], high = v[1];
    simd::dropFirstLane(low, high, simd::broadcast16(0xFFFF));
    for (int k = 0; k + 2 < 2 * n; ++k) v[k] = v[k + 2];
    v[2 * n - 2] = low;
    v[2 * n - 1] = high;
  }

  /// `x`: the left column that right pixel q maps to at disparity index 0.
  POMONA_OP void writeRight(int q, int x, std::uint16_t best, std::uint16_t index, int n) {
    // Without a branch: on real images it would often be mispredicted.
    const int column = x + index, at = index == pomona::kNoIndex ? 0 : index;
    const bool inside = (index - 1u < row_.disparities - 2u) & (column - 1u < width_ - 2u);
    const std::uint16_t absent = static_cast<std::uint16_t>(inside - 1);
    const std::uint16_t below = absent | sumsOf(column - 1, n)[row_.position[at - 1]];
    const std::uint16_t above = absent | sumsOf(column + 1, n)[row_.position[at + 1]];
    row_.right_index[q] = index;
    row_.right_best[q] = best;
    row_.right_below[q] = below;
    row_.right_above[q] = above;
  }

  const pomona::WinnerRow& row_;
  const int vectors_, width_;
  simd::U16 right_best_[2 * kCapacityVectors], right_label_[2 * kCapacityVectors];
};

}  // namespace
