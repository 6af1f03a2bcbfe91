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
    std::uint16_t* memory = recent_[x & (kRecent - 1)];
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
    std::uint16_t& at_best = memory[row_.position[index]];
    std::uint16_t& at_below = memory[row_.position[index > 0 ? index - 1 : 0]];
    std::uint16_t& at_above = memory[row_.position[index < row_.disparities - 1 ? index + 1 : index]];
    row_.index[x] = static_cast<std::uint16_t>(index);
    row_.best[x] = at_best;
    row_.below[x] = at_below;
    row_.above[x] = at_above;
    at_best = at_below = at_above = 0xFFFF;  // what is left decides the second-best, a few pixels later
    if (x + kDelay < width_) second<kVectors>(x + kDelay);
    right<kVectors>(x, sums);
  }

  /// Call after pixel 0.
  void finish() {
    for (int x = (kDelay < width_ ? kDelay : width_) - 1; x >= 0; --x) second<0>(x);
    // With negative disparities the rightmost columns to come still have candidates.
    for (int x = -1; x - row_.min_disparity >= 0; --x) emitRight<0>(x);
  }

 private:
  static constexpr int kWords = simd::kBytes / 2;
  static constexpr int kRecent = 8;
  static constexpr int kDelay = 4;  // reading a vector right after writing one of its words would stall

  template <int kVectors>
  POMONA_OP void second(int x) {
    const int n = kVectors ? kVectors : vectors_;
    const std::uint16_t* memory = recent_[x & (kRecent - 1)];
    simd::U16 smallest = simd::load16(memory);
    for (int k = 1; k < 2 * n; ++k) smallest = simd::min16(smallest, simd::load16(memory + k * kWords));
    row_.second[x] = simd::first16(simd::minimum16(smallest));
  }

  /// Right pixel q sees the sums S(q + d, d). The lanes hold the candidates of pixels x - d: pixel x adds its
  /// own, then right pixel x (less the smallest disparity) is complete and every lane moves on by one
  /// disparity.
  template <int kVectors>
  POMONA_OP void right(int x, const simd::U16* sums) {
    const int n = kVectors ? kVectors : vectors_;
    for (int k = 0; k < 2 * n; ++k)
      simd::keepSmaller(right_best_[k], right_label_[k], sums[k], simd::load16(row_.labels + k * kWords));
    emitRight<kVectors>(x);
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

  const pomona::WinnerRow& row_;
  const int vectors_, width_;
  simd::U16 right_best_[2 * kCapacityVectors], right_label_[2 * kCapacityVectors];
  alignas(64) std::uint16_t recent_[kRecent][2 * kCapacityVectors * kWords];
};

}  // namespace
