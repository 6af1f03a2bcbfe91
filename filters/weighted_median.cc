#include "filters/weighted_median.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "filters/guided_plane.h"

namespace pomona {
namespace {

constexpr float kJump_px = 1.0f;
constexpr double kDistanceScale_px = 9;
constexpr double kColorScale = 8;
constexpr int kSegment = 1024;  // columns of one kernel call at most

bool isTap(int taps, int dx, int dy) {
  return taps == kMedianTaps[0] ? dx % 2 == 0 && dy % 2 == 0 : (dx + dy) % 2 == 0;
}

MedianWindow makeWindow(int taps, std::ptrdiff_t stride) {
  constexpr int kRadius = MedianWindow::kRadius;
  MedianWindow window;
  int tap = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if (!isTap(taps, dx, dy)) continue;
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

void weightedMedian(ImageView<const float> in, GuideView guide, int taps, ImageView<float> out,
                    Arena& scratch, const FilterKernels& kernels, int threads) {
  if (taps != kMedianTaps[0] && taps != kMedianTaps[1])
    throw std::invalid_argument("weighted median taps are " + std::to_string(taps) + "; allowed: 25, 61");
  const int width = in.width;
  const auto median_at = kernels.weightedMedian[taps == kMedianTaps[1]];
  const Arena::Scope scope(scratch);
  const GuidedPlane plane(in, guide, MedianWindow::kRadius, scratch, threads);
  const MedianWindow window = makeWindow(taps, plane.row(0).stride);
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
        median_at(row, window, columns, count, out.row(y));
      }
    }
  });
}

}  // namespace pomona
