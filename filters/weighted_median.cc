#include "filters/weighted_median.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kRadius = kWeightedMedianRadius;
constexpr int kSide = 2 * kRadius + 1;
constexpr float kJump_px = 1.0f;
constexpr double kDistanceScale_px = 5;
constexpr int kSegment = 1024;  // columns of one kernel call at most

using SpatialWeights = std::array<float, kSide * kSide>;

SpatialWeights logWeights() {
  SpatialWeights weights;
  float* next = weights.data();
  for (int dy = -kRadius; dy <= kRadius; ++dy)
    for (int dx = -kRadius; dx <= kRadius; ++dx)
      *next++ = static_cast<float>(-std::sqrt(dx * dx + dy * dy) * std::numbers::log2e / kDistanceScale_px);
  return weights;
}

/// Columns in [begin, end) that are near a jump; returns how many.
int chosenColumns(const std::uint8_t* near_jump, const float* disparity, int begin, int end,
                  std::int32_t* columns) {
  int count = 0;
  for (int x = begin; x < end; ++x) {
    columns[count] = x;
    count += near_jump[x] & !std::isnan(disparity[x]);
  }
  return count;
}

}  // namespace

void weightedMedian(ImageView<const float> in, GuideView guide, ImageView<float> out,
                    WeightedMedianScratch& scratch, const FilterKernels& kernels, int threads) {
  const SpatialWeights log_weight = logWeights();
  const int width = in.width;
  scratch.plane.set(in, guide, kRadius, threads);
  scratch.near_jump.resize(width, in.height);
  parallelStrips(threads, in.height, 4, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y) {
      const GuidedRow row = scratch.plane.row(y);
      std::uint8_t* near_jump = scratch.near_jump.row(y);
      std::copy_n(row.disparity, width, out.row(y));
      kernels.nearJumps(row, width, kJump_px, near_jump);
      std::int32_t columns[kSegment];
      for (int x = 0; x < width; x += kSegment) {
        const int count = chosenColumns(near_jump, row.disparity, x, std::min(width, x + kSegment), columns);
        kernels.weightedMedian(row, log_weight.data(), columns, count, out.row(y));
      }
    }
  });
}

}  // namespace pomona
