// Winner-take-all for both views, pixel after pixel from right to left.
#pragma once

#include "sgm/kernels.h"
#include "sgm/kernels/dispatch.inl"

namespace {

using pomona::WinnerRow;

/// kLabelBits > 0: sums are small enough to share a word with a label of the disparity index, sum <<
/// kLabelBits | index >> shared bits. One minimum then finds both, and the lowest label wins a tie by itself;
/// of the disparities that share it, the first whose word is the minimum. 0: indices have words of their own.
template <int kVectors, int kLabelBits>
class Winner {
 public:
  /// `is_resumed`: goes on where another one was suspended.
  Winner(const WinnerRow& row, int vectors, int width, bool is_resumed)
      : row_(row), vectors_(vectors), width_(width) {
    for (int k = 0; k < 2 * vectors; ++k) {
      right_best_[k] = is_resumed ? simd::load16(bestBorder(k)) : simd::broadcast16(kNone);
      right_label_[k] = is_resumed ? simd::load16(labelBorder(k)) : simd::broadcast16(pomona::kNoIndex);
    }
  }

  /// Instead of finish(), if pixels are left for another stretch of the row.
  void suspend() const {
    for (int k = 0; k < wordVectors(); ++k) {
      simd::store16(bestBorder(k), right_best_[k]);
      simd::store16(labelBorder(k), right_label_[k]);
    }
  }

  /// Keeps the sums of pixel x, 2 * vectors word vectors, for chooseWinners().
  POMONA_OP void put(std::ptrdiff_t x, const simd::U16* sums) {
    std::uint16_t* memory = sumsOf(row_, x);
    for (int k = 0; k < wordVectors(); ++k) {
      simd::U16 s = sums[k];
      if constexpr (kPacked)
        s = simd::or16(simd::shiftLeft16<kLabelBits>(s), simd::load16(row_.labels + k * kWords));
      else if (row_.padded)
        s = simd::or16(s, simd::load16(row_.padding + k * kWords));
      simd::store16(memory + k * kWords, s);
    }
  }

  /// Winners of the pixels x_first, x_first - 1, ... : `count` of them, all of which have been put. To be
  /// called for one run of pixels after the other, right to left. A loop apart from the one that adds the
  /// sums: its pixels don't wait for each other, and each of the two loops keeps its pointers in registers.
  __attribute__((noinline)) void chooseWinners(int x_first, int count) {
    const int q_first = x_first - row_.min_disparity;
    q_first < width_&& q_first - count + 1 >= 0 ? choose<true>(x_first, count)
                                                : choose<false>(x_first, count);
  }

  /// Call after pixel 0. With negative disparities the rightmost columns to come still have candidates.
  void finish() {
    for (int x = -1; x - row_.min_disparity >= 0; --x) {
      if (x - row_.min_disparity < width_) emitRight(row_, x, right_best_, right_label_);
      advance(right_best_);
      if constexpr (!kPacked) advance(right_label_);
    }
    if constexpr (kPacked) {
      if (sharedBits() == 0) {
        unpackIndex(row_.best, row_.index);
        unpackIndex(row_.right_best, row_.right_index);
      }
      std::uint16_t* const packed[] = {row_.best,       row_.below,       row_.above,      row_.second,
                                       row_.right_best, row_.right_below, row_.right_above};
      for (std::uint16_t* sums : packed) unpackSums(sums);
    }
    removeOutside();
  }

 private:
  static constexpr int kWords = simd::kBytes / 2;
  static constexpr int kCapacity = 2 * (kVectors ? kVectors : pomona::kMaxDisparities / simd::kBytes);
  static constexpr bool kPacked = kLabelBits > 0;
  static constexpr int kLabelMask = (1 << kLabelBits) - 1;
  static constexpr std::uint16_t kNone = 0xFFFF;  // above every sum, packed or not

  std::uint16_t* bestBorder(int k) const { return row_.right_border + k * kWords; }
  std::uint16_t* labelBorder(int k) const { return bestBorder(wordVectors() + k); }
  POMONA_OP int sharedBits() const {
    return kVectors ? pomona::sharedBits(kVectors * simd::kBytes, kLabelBits) : row_.shared_bits;
  }
  POMONA_OP int wordVectors() const { return 2 * (kVectors ? kVectors : vectors_); }
  POMONA_OP void copy(const simd::U16* from, simd::U16* to) const {
    for (int k = 0; k < wordVectors(); ++k) to[k] = from[k];
  }
  POMONA_OP std::uint16_t* sumsOf(const WinnerRow& row, std::ptrdiff_t x) const {
    return row.recent + (x & row.recent_mask) * (wordVectors() * kWords);
  }

  // Right pixel q sees the sums S(q + d, d). The lanes of right_best hold the candidates of the pixels x - d:
  // pixel x adds its own, then the right pixel of disparity index 0 is complete and every lane moves on by
  // one disparity.

  /// The index whose word is `best`, given the word of every index that may share its label.
  template <typename WordAt>
  POMONA_OP int indexOf(std::uint16_t best, WordAt wordAt) const {
    int index = (best & kLabelMask) << sharedBits();
    for (int i = 1, is_later = 1; i < 1 << sharedBits(); ++i) {
      is_later &= wordAt(index) != best;
      index += is_later;
    }
    return index;
  }

  POMONA_OP void choosePacked(const WinnerRow& row, int x, const std::uint16_t* sums, simd::U16* right_best) {
    simd::U16 smallest = simd::load16(sums);
    for (int k = 1; k < wordVectors(); ++k) smallest = simd::min16(smallest, simd::load16(sums + k * kWords));
    const std::uint16_t best = simd::smallest16(smallest);
    const int index = indexOf(best, [&](int d) { return sums[row.position[d]]; });
    const std::uint16_t* near = row.near + static_cast<std::ptrdiff_t>(index) * (wordVectors() * kWords);
    simd::U16 second = simd::broadcast16(kNone);
    for (int k = 0; k < wordVectors(); ++k) {
      const simd::U16 s = simd::load16(sums + k * kWords);
      second = simd::min16(second, simd::or16(s, simd::load16(near + k * kWords)));
      right_best[k] = simd::min16(right_best[k], s);
    }
    if (sharedBits() > 0) row.index[x] = static_cast<std::uint16_t>(index);
    row.best[x] = best;
    row.below[x] = sums[row.position[index - 1]];
    row.above[x] = sums[row.position[index + 1]];
    row.second[x] = simd::smallest16(second);
  }

  POMONA_OP void chooseApart(const WinnerRow& row, int x, const std::uint16_t* sums, simd::U16* right_best,
                             simd::U16* right_label) {
    simd::U16 smallest = simd::load16(sums);
    for (int k = 1; k < wordVectors(); ++k) smallest = simd::min16(smallest, simd::load16(sums + k * kWords));
    const std::uint16_t best = simd::smallest16(smallest);
    const simd::U16 all_best = simd::broadcast16(best);
    const int n = wordVectors() / 2;
    int index = pomona::kMaxDisparities;
    for (int j = 0; j < n; ++j) {
      const std::uint64_t lanes = simd::equalLanes(simd::load16(sums + 2 * j * kWords),
                                                   simd::load16(sums + (2 * j + 1) * kWords), all_best);
      const int d = n * (lanes ? __builtin_ctzll(lanes) : pomona::kMaxDisparities) + j;
      index = d < index ? d : index;
    }
    const simd::U16 first_near = simd::broadcast16(static_cast<std::uint16_t>(index - 1));
    simd::U16 second = simd::broadcast16(kNone);
    for (int k = 0; k < wordVectors(); ++k) {
      const simd::U16 s = simd::load16(sums + k * kWords), label = simd::load16(row.labels + k * kWords);
      second = simd::minimumAway(second, s, label, first_near);
      simd::keepSmaller(right_best[k], right_label[k], s, label);
    }
    row.index[x] = static_cast<std::uint16_t>(index);
    row.best[x] = best;
    row.below[x] = sums[row.position[index - 1]];
    row.above[x] = sums[row.position[index + 1]];
    row.second[x] = simd::smallest16(second);
  }

  template <bool kAllInside>
  POMONA_OP void choose(int x_first, int count) {
    const WinnerRow row = row_;  // stores of vectors may alias everything but locals
    const int width = width_;
    simd::U16 right_best[kCapacity], right_label[kCapacity];
    copy(right_best_, right_best);
    copy(right_label_, right_label);
    for (int x = x_first; x > x_first - count; --x) {
      const std::uint16_t* sums = sumsOf(row, x);
      kPacked ? choosePacked(row, x, sums, right_best) : chooseApart(row, x, sums, right_best, right_label);
      const int q = x - row.min_disparity;
      if (kAllInside || (q >= 0 && q < width)) emitRight(row, x, right_best, right_label);
      advance(right_best);
      if constexpr (!kPacked) advance(right_label);
    }
    copy(right_best, right_best_);
    copy(right_label, right_label_);
  }

  /// The right pixel that left pixel x maps to at disparity index 0. Its sums may be anything where
  /// removeOutside() will find no neighbours; a branch would often be mispredicted.
  POMONA_OP void emitRight(const WinnerRow& row, int x, const simd::U16* right_best,
                           const simd::U16* right_label) const {
    const std::uint16_t best = simd::first16(right_best[0]);
    const auto wordAt = [&](int d) { return x + d < 0 ? kNone : sumsOf(row, x + d)[row.position[d]]; };
    const int index = kPacked ? indexOf(best, wordAt) : simd::first16(right_label[0]) & row.index_mask;
    const int q = x - row.min_disparity;
    row.right_best[q] = best;
    row.right_below[q] = sumsOf(row, x + index - 1)[row.position[index - 1]];
    row.right_above[q] = sumsOf(row, x + index + 1)[row.position[index + 1]];
    if constexpr (!kPacked)
      row.right_index[q] = simd::first16(right_label[0]);
    else if (sharedBits() > 0)
      row.right_index[q] = best == kNone ? pomona::kNoIndex : static_cast<std::uint16_t>(index);
  }

  POMONA_OP void advance(simd::U16* v) const {
    simd::U16 low = v[0], high = v[1];
    simd::dropFirstLane(low, high, simd::broadcast16(kNone));
    for (int k = 0; k + 2 < wordVectors(); ++k) v[k] = v[k + 2];
    v[wordVectors() - 2] = low;
    v[wordVectors() - 1] = high;
  }

  void unpackIndex(const std::uint16_t* __restrict sums, std::uint16_t* __restrict index) const {
    for (int x = 0; x < width_; ++x)
      index[x] = sums[x] == kNone ? pomona::kNoIndex : static_cast<std::uint16_t>(sums[x] & kLabelMask);
  }
  void unpackSums(std::uint16_t* sums) const {
    for (int x = 0; x < width_; ++x)
      sums[x] = sums[x] == kNone ? kNone : static_cast<std::uint16_t>(sums[x] >> kLabelBits);
  }

  /// Right pixels have two neighbours on the diagonal of their sums only within the range and the left image.
  void removeOutside() const {
    const std::uint16_t* __restrict index = row_.right_index;
    std::uint16_t* __restrict below = row_.right_below;
    std::uint16_t* __restrict above = row_.right_above;
    const unsigned indices = static_cast<unsigned>(row_.disparities) - 2u,
                   columns = static_cast<unsigned>(width_) - 2u;
    const bool none = row_.disparities < 3 || width_ < 3;
    for (int q = 0; q < width_; ++q) {
      const unsigned i = index[q], column = static_cast<unsigned>(q + row_.min_disparity) + i;
      const std::uint16_t absent = none | (i - 1u >= indices) | (column - 1u >= columns) ? kNone : 0;
      below[q] |= absent;
      above[q] |= absent;
    }
  }

  const WinnerRow row_;
  const int vectors_, width_;
  simd::U16 right_best_[kCapacity], right_label_[kCapacity];
};

}  // namespace
