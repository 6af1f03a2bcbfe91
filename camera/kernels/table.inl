// All kernels of this folder, compiled for the instruction set of the including file. GCC vectorises the
// loops as they stand.
#include "camera/kernels.h"

namespace pomona {
namespace {

/// In words: with weights of 64 coarse + fine, both sums fit, and the mean is (coarse + fine / 64) / 64.
void interpolateRows8(const WeightedRows<std::uint8_t>& rows, int begin, int end,
                      std::uint8_t* __restrict out) {
  static_assert(kRowWeights == 64 * 64);  // so fine is within +-32, and no sum of four leaves a word
  const std::uint8_t *a = rows.row[0], *b = rows.row[1], *c = rows.row[2], *d = rows.row[3];
  short coarse[4], fine[4];
  for (int i = 0; i < 4; ++i) {
    fine[i] = static_cast<short>(((rows.weight[i] + 32) & 63) - 32);
    coarse[i] = static_cast<short>((rows.weight[i] - fine[i]) / 64);
  }
  const short ca = coarse[0], cb = coarse[1], cc = coarse[2], cd = coarse[3];
  const short fa = fine[0], fb = fine[1], fc = fine[2], fd = fine[3];
  for (int x = begin; x < end; ++x) {
    const short high = static_cast<short>(ca * a[x] + cb * b[x] + cc * c[x] + cd * d[x]);
    const short low = static_cast<short>(fa * a[x] + fb * b[x] + fc * c[x] + fd * d[x]);
    const short mean = static_cast<short>(static_cast<short>(high + (low >> 6) + 32) >> 6);
    out[x] = static_cast<std::uint8_t>(mean < 0 ? 0 : mean > 255 ? 255 : mean);
  }
}

void interpolateRows16(const WeightedRows<std::uint16_t>& rows, int begin, int end,
                       std::uint16_t* __restrict out) {
  const std::uint16_t *a = rows.row[0], *b = rows.row[1], *c = rows.row[2], *d = rows.row[3];
  const int wa = rows.weight[0], wb = rows.weight[1], wc = rows.weight[2], wd = rows.weight[3];
  constexpr int kMost = 65535;
  for (int x = begin; x < end; ++x) {
    const int mean = (wa * a[x] + wb * b[x] + wc * c[x] + wd * d[x] + kRowWeights / 2) / kRowWeights;
    out[x] = static_cast<std::uint16_t>(mean < 0 ? 0 : mean > kMost ? kMost : mean);
  }
}

template <int kScale>
inline void reduceBlocksOf(const std::uint8_t* in, std::ptrdiff_t stride, int width,
                           std::uint8_t* __restrict out) {
  for (int x = 0; x < width; ++x) {
    unsigned short sum = kScale * kScale / 2;
    for (int y = 0; y < kScale; ++y)
      for (int i = 0; i < kScale; ++i) sum += in[y * stride + kScale * x + i];
    out[x] = static_cast<std::uint8_t>(sum / (kScale * kScale));
  }
}

void reduceBlocks(const std::uint8_t* in, std::ptrdiff_t stride, int scale, int width, std::uint8_t* out) {
  if (scale == 4) return reduceBlocksOf<4>(in, stride, width, out);
  if (scale == 2) return reduceBlocksOf<2>(in, stride, width, out);
  reduceBlocksOf<1>(in, stride, width, out);
}

inline std::uint8_t contrastOf(int here, int surroundings) {
  const int v = 128 + (4 * here - surroundings) / 4;
  return static_cast<std::uint8_t>(v < 0 ? 0 : v > 255 ? 255 : v);
}

void contrastRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below, int width,
                 std::uint8_t* __restrict out) {
  constexpr int kReach = kContrastReach;
  const auto atBorder = [=](int x) {
    const int before = here[x < kReach ? 0 : x - kReach],
              after = here[x + kReach < width ? x + kReach : width - 1];
    return contrastOf(here[x], before + after + above[x] + below[x]);
  };
  for (int x = 0; x < width && x < kReach; ++x) out[x] = atBorder(x);
  for (int x = kReach; x < width - kReach; ++x)
    out[x] = contrastOf(here[x], here[x - kReach] + here[x + kReach] + above[x] + below[x]);
  for (int x = width > 2 * kReach ? width - kReach : kReach; x < width; ++x) out[x] = atBorder(x);
}

constexpr CameraKernels kTable = {.interpolate8 = interpolateRows8,
                                  .interpolate16 = interpolateRows16,
                                  .reduceBlocks = reduceBlocks,
                                  .contrast = contrastRow};

}  // namespace
}  // namespace pomona
