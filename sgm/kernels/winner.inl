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
      sums[k] = simd::or16(sums[k], simd::load16(row_.padding + k * kWords));
      simd::store16(memory + k * kWords, sums[k]);
      smallest = simd::min16(smallest, sums[k]);
    }
    const simd::U16 best = simd::minimum16(smallest);
    int index = pomona::kMaxDisparities;
    for (int j = 0; j < n; ++j) {
      const std::uint64_t lanes = simd::equalLanes(sums[2 * j], sums[2 * j + 1], best);
      const int lane = lanes ? __builtin_ctzll(lanes) : pomona::kMaxDisparities;
      index = n * lane + j < index ? n * lane + j : index;
    }
    const Neighbours at = neighbours(index);
    row_.index[x] = static_cast<std::uint16_t>(index);
    row_.best[x] = memory[at.here];
    row_.below[x] = memory[at.below];
    row_.above[x] = memory[at.above];
    // What is left decides the second-best. It is looked for a few pixels later: reading a vector right after
    // writing one of its words would stall.
    memory[at.here] = memory[at.below] = memory[at.above] = 0xFFFF;
    if (x + kDelay < width_) second<kVectors>(x + kDelay);

    // Right pixel q sees the sums S(q + d, d). The lanes hold the candidates of the pixels x - d: pixel x
    // adds its own, then the right pixel of disparity index 0 is complete and every lane moves on by one
    // disparity.
    for (int k = 0; k < 2 * n; ++k)
      simd::keepSmaller(right_best_[k], right_label_[k], sums[k], simd::load16(row_.labels + k * kWords));
    emitRight<kVectors>(x);
    if (x + kDelay + 1 < width_) refineRight(x + kDelay + 1, n);
  }

  /// Call after pixel 0.
  void finish() {
    for (int x = (kDelay < width_ ? kDelay : width_) - 1; x >= 0; --x) second<0>(x);
    for (int x = (kDelay + 1 < width_ ? kDelay + 1 : width_) - 1; x >= 0; --x) refineRight(x, vectors_);
    // With negative disparities the rightmost columns to come still have candidates.
    for (int x = -1; x - row_.min_disparity >= 0; --x) {
      emitRight<0>(x);
      refineRight(x, vectors_);
    }
  }

 private:
  static constexpr int kWords = simd::kBytes / 2;
  static constexpr int kDelay = pomona::kWinnerDelay;

  struct Neighbours {
    int below, here, above;  // word positions
  };
  POMONA_OP Neighbours neighbours(int index) const {
    return {row_.position[index > 0 ? index - 1 : 0], row_.position[index],
            row_.position[index < row_.disparities - 1 ? index + 1 : index]};
  }
  POMONA_OP std::uint16_t* sumsOf(int x, int vectors) const {
    return row_.recent + static_cast<std::ptrdiff_t>(x & row_.recent_mask) * (2 * vectors * kWords);
  }

  template <int kVectors>
  POMONA_OP void second(int x) {
    const int n = kVectors ? kVectors : vectors_;
    std::uint16_t* memory = sumsOf(x, n);
    simd::U16 smallest = simd::load16(memory);
    for (int k = 1; k < 2 * n; ++k) smallest = simd::min16(smallest, simd::load16(memory + k * kWords));
    row_.second[x] = simd::first16(simd::minimum16(smallest));
    const Neighbours at = neighbours(row_.index[x]);
    memory[at.above] = row_.above[x];
    memory[at.below] = row_.below[x];
    memory[at.here] = row_.best[x];
  }

  template <int kVectors>
  POMONA_OP void emitRight(int x) {
    const int n = kVectors ? kVectors : vectors_;
    const int q = x - row_.min_disparity;
    if (q >= 0 && q < width_) row_.right_index[q] = simd::first16(right_label_[0]);
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

  /// The sums around the winner of the right pixel that emitRight(x) wrote.
  POMONA_OP void refineRight(int x, int n) {
    const int q = x - row_.min_disparity;
    if (q < 0 || q >= width_) return;
    std::uint16_t best = 0xFFFF, below = 0xFFFF, above = 0xFFFF;
    const int index = row_.right_index[q], column = x + index;
    if (index != pomona::kNoIndex) best = sumsOf(column, n)[row_.position[index]];
    if (index != pomona::kNoIndex && index > 0 && index < row_.disparities - 1 && column > 0 &&
        column < width_ - 1) {
      below = sumsOf(column - 1, n)[row_.position[index - 1]];
      above = sumsOf(column + 1, n)[row_.position[index + 1]];
    }
    row_.right_best[q] = best;
    row_.right_below[q] = below;
    row_.right_above[q] = above;
  }

  const pomona::WinnerRow& row_;
  const int vectors_, width_;
  simd::U16 right_best_[2 * kCapacityVectors], right_label_[2 * kCapacityVectors];
};

}  // namespace
