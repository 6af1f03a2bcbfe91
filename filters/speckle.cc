#include "filters/speckle.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

// Strips are the same for every thread count: each has its own part of the array of runs.
constexpr int kStripRows = 32;

int sizeOfComponent(const SpeckleRun* runs, int i) {
  while (runs[i].link >= 0) i = runs[i].link;  // read only: strips share the forest
  return -runs[i].link;
}

}  // namespace

void removeSpeckles(ImageView<float> disparity, ImageView<std::uint8_t> state, int min_size_px,
                    float max_step_px, SpeckleScratch& scratch, const FilterKernels& kernels, int threads) {
  const int width = disparity.width, height = disparity.height;
  if (disparity.empty() || min_size_px <= 1) return;
  scratch.runs.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  scratch.rows.resize(static_cast<std::size_t>(height));
  scratch.breaks.resize((width + 63) / 64, height);
  SpeckleRun* runs = scratch.runs.data();
  SpeckleScratch::RowRuns* rows = scratch.rows.data();
  const auto rowAt = [&](int y) {
    return SpeckleRow{disparity.row(y), scratch.breaks.row(y), rows[y].first};
  };
  const auto uniteWithAbove = [&](int y) {
    kernels.uniteRuns(rowAt(y - 1), rowAt(y), width, max_step_px, min_size_px, runs);
  };

  parallelFor(threads, (height + kStripRows - 1) / kStripRows, [&](int strip) {
    const int y_begin = strip * kStripRows, y_end = std::min(height, y_begin + kStripRows);
    int next = y_begin * width;
    for (int y = y_begin; y < y_end; ++y) {
      const int first = next;
      next += kernels.findRuns(disparity.row(y), width, max_step_px, min_size_px, scratch.breaks.row(y),
                               runs + first);
      rows[y] = {first, next};
      if (y > y_begin) uniteWithAbove(y);
    }
  });
  for (int y = kStripRows; y < height; y += kStripRows) uniteWithAbove(y);

  parallelStrips(threads, height, kStripRows, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y)
      for (int i = rows[y].first; i < rows[y].last; ++i) {
        if (sizeOfComponent(runs, i) >= min_size_px) continue;
        const int begin = runs[i].begin, end = i + 1 < rows[y].last ? runs[i + 1].begin : width;
        std::fill(disparity.row(y) + begin, disparity.row(y) + end, std::numeric_limits<float>::quiet_NaN());
        std::fill(state.row(y) + begin, state.row(y) + end, static_cast<std::uint8_t>(PixelState::kSpeckle));
      }
  });
}

}  // namespace pomona
