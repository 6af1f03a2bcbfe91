#include "filters/weighted_median.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "filters/guided_plane.h"

namespace pomona {
namespace {

constexpr float kJump_px = 1.0f;
constexpr double kDistanceScale_px = 9;
constexpr double kColorScale = 8;
constexpr int kSegment = 1024;  // columns of one kernel call at most

MedianWindow makeWindow(std::ptrdiff_t stride) {
  constexpr int kRadius = MedianWindow::kRadius;
  MedianWindow window;
  int tap = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if ((dx + dy) % 2 != 0) continue;
      const double distance = std::sqrt(dx * dx + dy * dy);
      window.offset[tap] = static_cast<std::int32_t>(dy * stride + dx);
      window.log_weight[tap++] = static_cast<float>(-distance * std::numbers::log2e / kDistanceScale_px);
    }
  window.color_scale = static_cast<float>(std::numbers::log2e / (3 * kColorScale));
  return window;
}

/// Columns in [begin, end) that are near a jump; returns how many.
int chosenColumns(const std::uint8_t* near_jump, int begin, int end, std::int32_t* columns) {
  int count = 0;
  for (int x = begin; x < end; ++x) {
    columns[count] = x;
    count += near_jump[x];
  }
  return count;
}

}  // namespace

void weightedMedian(ImageView<const float> in, GuideView guide, ImageView<float> out, Arena& scratch,
                    const FilterKernels& kernels, int threads) {
  const int width = in.width;
  const Arena::Scope scope(scratch);
  const GuidedPlane plane(in, guide, MedianWindow::kRadius, scratch, threads);
  const MedianWindow window = makeWindow(plane.row(0).stride);
  const auto jumps = scratch.image<std::uint8_t>(width, in.height);
  parallelStrips(threads, in.height, 4, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      const GuidedRow row = plane.row(y);
      std::uint8_t* near_jump = jumps.row(y);
      if (out.data != in.data) std::copy_n(row.disparity, width, out.row(y));
      kernels.nearJumps(row, width, kJump_px, near_jump);
      std::int32_t columns[kSegment];
      for (int x = 0; x < width; x += kSegment) {
        const int count = chosenColumns(near_jump, x, std::min(width, x + kSegment), columns);
        kernels.weightedMedian(row, window, columns, count, out.row(y));
      }
    }
  });
}

}  // namespace pomona
