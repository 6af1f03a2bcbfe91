#include "camera/row_align.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kStepBits = 6, kSteps = 1 << kStepBits;  // of a pixel
constexpr int kTaps = 4;
using Weights = std::array<int, kTaps>;

// Of the rows from one above to two below, for places so many steps below a row.
std::array<Weights, kSteps> cubicWeights() {
  const auto rounded = [](double weight) { return static_cast<int>(std::lround(kRowWeights * weight)); };
  std::array<Weights, kSteps> weights;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const int above = rounded(t * (-0.5 + t * (1 - 0.5 * t))), below = rounded(t * (0.5 + t * (2 - 1.5 * t))),
              farthest = rounded(0.5 * t * t * (t - 1));
    weights[i] = {above, kRowWeights - above - below - farthest, below, farthest};
  }
  return weights;
}

}  // namespace

std::optional<RowOffsetPlane> rowCorrection(const RowOffsets& rows) {
  constexpr float kLeast_px = 0.1f, kMostScatter_px = 0.25f, kLeastTilt_px = 0.5f;
  if (!(rows.scatter_px <= kMostScatter_px)) return {};  // NaN, too
  const float tilt_px = std::abs(rows.plane.slope_x_px) + std::abs(rows.plane.slope_y_px);
  if (tilt_px > kLeastTilt_px) return rows.plane;
  if (std::abs(rows.median_px) < kLeast_px) return {};
  return RowOffsetPlane{rows.median_px, 0, 0};
}

template <typename T>
void alignRows(ImageView<const T> right, const RowOffsetPlane& offset, Image<T>& out,
               const CameraKernels& kernels, int threads) {
  static const std::array<Weights, kSteps> kWeights = cubicWeights();
  const int width = right.width, height = right.height;
  out.resize(width, height);
  parallelStrips(threads, height, 16, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      const auto place = [&](int x) {  // in steps
        return static_cast<int>(std::lround(kSteps * (y + offset.at(x, y, width, height))));
      };
      for (int begin = 0, end = 0; begin < width; begin = end) {  // columns that share their place
        const int here = place(begin);
        end = place(width - 1) == here ? width : begin + 1;
        while (end < width && place(end) == here) ++end;
        const int row = here >> kStepBits, step = here & (kSteps - 1);
        const auto source = [&](int i) { return right.row(std::clamp(row + i, 0, height - 1)); };
        const Weights& weight = kWeights[static_cast<std::size_t>(step)];
        const WeightedRows<T> rows{{source(-1), source(0), source(1), source(2)},
                                   {weight[0], weight[1], weight[2], weight[3]}};
        if constexpr (sizeof(T) == 1)
          kernels.interpolate8(rows, begin, end, out.row(y));
        else
          kernels.interpolate16(rows, begin, end, out.row(y));
      }
    }
  });
}

template void alignRows(ImageView<const std::uint8_t>, const RowOffsetPlane&, Image<std::uint8_t>&,
                        const CameraKernels&, int);
template void alignRows(ImageView<const std::uint16_t>, const RowOffsetPlane&, Image<std::uint16_t>&,
                        const CameraKernels&, int);

}  // namespace pomona
