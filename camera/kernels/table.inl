// All kernels of this folder, compiled for the instruction set of the including file. GCC vectorises the
// loops as they stand.
#include "camera/kernels.h"

namespace pomona {
namespace {

template <typename T>
void interpolateRows(const WeightedRows<T>& rows, int begin, int end, T* __restrict out) {
  const T *a = rows.row[0], *b = rows.row[1], *c = rows.row[2], *d = rows.row[3];
  const int wa = rows.weight[0], wb = rows.weight[1], wc = rows.weight[2], wd = rows.weight[3];
  constexpr int kMost = static_cast<T>(-1);
  for (int x = begin; x < end; ++x) {
    const int mean = (wa * a[x] + wb * b[x] + wc * c[x] + wd * d[x] + kRowWeights / 2) / kRowWeights;
    out[x] = static_cast<T>(mean < 0 ? 0 : mean > kMost ? kMost : mean);
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

constexpr CameraKernels kTable = {.interpolate8 = interpolateRows<std::uint8_t>,
                                  .interpolate16 = interpolateRows<std::uint16_t>,
                                  .reduceBlocks = reduceBlocks,
                                  .contrast = contrastRow};

}  // namespace
}  // namespace pomona
