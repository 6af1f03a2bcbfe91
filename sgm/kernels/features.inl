// Per-pixel features. GCC vectorises these loops as they stand.
#pragma once

#include <cstdint>

#include "sgm/kernels.h"

namespace {

template <typename T>
void grayRow(const T* bgr, int width, T* __restrict gray) {
  for (int x = 0; x < width; ++x)
    gray[x] = static_cast<T>((29u * bgr[3 * x] + 150u * bgr[3 * x + 1] + 77u * bgr[3 * x + 2] + 128u) >> 8);
}

/// Eight comparisons per pixel, packed into a byte.
template <typename T>
void censusRow(const T* const a[8], const T* const b[8], int width, std::uint8_t* __restrict out) {
  const T *a0 = a[0], *a1 = a[1], *a2 = a[2], *a3 = a[3], *a4 = a[4], *a5 = a[5], *a6 = a[6], *a7 = a[7];
  const T *b0 = b[0], *b1 = b[1], *b2 = b[2], *b3 = b[3], *b4 = b[4], *b5 = b[5], *b6 = b[6], *b7 = b[7];
  for (int x = 0; x < width; ++x) {
    std::uint8_t code = a0[x] < b0[x] ? 1 : 0;
    code |= a1[x] < b1[x] ? 2 : 0;
    code |= a2[x] < b2[x] ? 4 : 0;
    code |= a3[x] < b3[x] ? 8 : 0;
    code |= a4[x] < b4[x] ? 16 : 0;
    code |= a5[x] < b5[x] ? 32 : 0;
    code |= a6[x] < b6[x] ? 64 : 0;
    code |= a7[x] < b7[x] ? 128 : 0;
    out[x] = code;
  }
}

void sobelRow(const std::uint8_t* const rows[3], int width, std::uint8_t* __restrict out) {
  const std::uint8_t *above = rows[0], *here = rows[1], *below = rows[2];
  for (int x = 0; x < width; ++x) {
    const short sum = static_cast<short>(above[x + 1] - above[x - 1] + 2 * (here[x + 1] - here[x - 1]) +
                                         below[x + 1] - below[x - 1]);
    const short v = static_cast<short>(128 + (sum >> 2));
    out[x] = static_cast<std::uint8_t>(v < 0 ? 0 : v > 255 ? 255 : v);
  }
}

constexpr int kColorBlock = 256;

/// A block of a row's pixels and one on either side, a plane per channel. The steps to several neighbours are
/// computed from them: taking pixels apart costs more than a step does.
template <int kChannels>
struct ColorPlanes {
  std::uint8_t plane[kChannels][kColorBlock + 2] = {};

  /// Column x - 1 + i becomes element i, if there is one.
  void take(const std::uint8_t* row, int width, int x, int count) {
    const int first = x > 0 ? 0 : 1, last = x + count < width ? count + 1 : count;
    const int from = kChannels * (x - 1);
    for (int i = first; i <= last; ++i)
      for (int c = 0; c < kChannels; ++c) plane[c][i] = row[from + kChannels * i + c];
  }
};

/// The largest difference of a channel, of the elements from a_begin and from b_begin on.
template <int kChannels>
void stepsBetween(const ColorPlanes<kChannels>& a, int a_begin, const ColorPlanes<kChannels>& b, int b_begin,
                  int count, std::uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    std::uint8_t step = 0;
    for (int c = 0; c < kChannels; ++c) {
      const std::uint8_t p = a.plane[c][a_begin + i], q = b.plane[c][b_begin + i];
      const std::uint8_t difference = static_cast<std::uint8_t>((p > q ? p : q) - (p < q ? p : q));
      step = difference > step ? difference : step;
    }
    out[i] = step;
  }
}

template <int kChannels>
void colorStepRowsOf(const pomona::ColorStepRows& r) {
  ColorPlanes<kChannels> above, here;
  const auto& beside = r.left_of_above ? above : here;
  for (int x = 0; x < r.width; x += kColorBlock) {
    const int count = r.width - x < kColorBlock ? r.width - x : kColorBlock;
    for (int i = 0; i < kChannels * count; i += 64) __builtin_prefetch(r.ahead + kChannels * x + i);
    above.take(r.row_above, r.width, x, count);
    here.take(r.row, r.width, x, count);
    stepsBetween(beside, 1, beside, 0, count, r.left + x);
    stepsBetween(here, 1, above, 1, count, r.above + x);
    if (r.above_left == nullptr) continue;
    stepsBetween(here, 1, above, 0, count, r.above_left + x);
    stepsBetween(here, 1, above, 2, count, r.above_right + x);
  }
}

void colorStepRows(const pomona::ColorStepRows& r) {
  r.channels == 1 ? colorStepRowsOf<1>(r) : colorStepRowsOf<3>(r);
}

}  // namespace
