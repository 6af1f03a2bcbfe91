#include "filters/speckle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "filters/flags.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

/// Known pixels [begin, end) of one row whose neighbours differ by at most the step; a node of a union-find
/// forest whose roots have the lowest index of their component.
struct Run {
  int begin, end;
  int parent;
  int size;  // pixels of the component; meaningful in roots
};
struct RowRuns {
  int first, last;  // runs[first] up to, not including, runs[last]
};

// Strips are the same for every thread count: each has its own part of the array of runs.
constexpr int kStripRows = 32;

/// Halves the path to the root on its way.
int findRoot(Run* runs, int i) {
  while (runs[i].parent != i) {
    runs[i].parent = runs[runs[i].parent].parent;
    i = runs[i].parent;
  }
  return i;
}

void unite(Run* runs, int a, int b) {
  a = findRoot(runs, a);
  b = findRoot(runs, b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  runs[b].parent = a;
  runs[a].size += runs[b].size;
}

/// Calls `visit(x)` in rising order for each x in [1, width) that `flag(begin, count, flags)` flags.
template <typename Flag, typename Visit>
void forEachFlagged(int width, Flag flag, Visit visit) {
  FlagChunk chunk;
  for (int begin = 1; begin < width; begin += FlagChunk::kPixels) {
    const int count = std::min(FlagChunk::kPixels, width - begin);
    flag(begin, count, chunk.flags);
    chunk.forEachSet(count, [&](int i) { visit(begin + i); });
  }
}

/// Appends the runs of a row at `next`; returns the index after the last one. Unknown pixels lie between
/// runs.
int appendRuns(const float* row, int width, float max_step_px, const FilterKernels& kernels, Run* runs,
               int next) {
  int begin = 0;
  const auto close = [&](int end) {
    if (!std::isnan(row[begin])) {
      runs[next] = {begin, end, next, end - begin};
      ++next;
    }
    begin = end;
  };
  forEachFlagged(
      width,
      [&](int x, int count, std::uint8_t* flags) { kernels.breaks(row + x, count, max_step_px, flags); },
      close);
  close(width);
  return next;
}

/// Unites the runs of two neighbouring rows that are connected somewhere.
void linkRows(const float* upper, RowRuns above, const float* lower, RowRuns below, int width,
              float max_step_px, const FilterKernels& kernels, Run* runs) {
  int a = above.first, b = below.first;
  const auto link = [&](int x) {  // both pixels are known, so both lie on runs
    while (runs[a].end <= x) ++a;
    while (runs[b].end <= x) ++b;
    unite(runs, a, b);
  };
  if (std::fabs(upper[0] - lower[0]) <= max_step_px) link(0);
  forEachFlagged(
      width,
      [&](int x, int count, std::uint8_t* flags) {
        kernels.links(upper + x, lower + x, count, max_step_px, flags);
      },
      link);
}

}  // namespace

void removeSpeckles(ImageView<float> disparity, ImageView<std::uint8_t> state, int min_size_px,
                    float max_step_px, Arena& scratch, const FilterKernels& kernels, int threads) {
  const int width = disparity.width, height = disparity.height;
  if (disparity.empty() || min_size_px <= 1) return;
  const Arena::Scope scope(scratch);
  RowRuns* const rows = scratch.take<RowRuns>(static_cast<std::size_t>(height));
  // Room for a run per pixel.
  Run* const runs = scratch.take<Run>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto link = [&](int y) {
    linkRows(disparity.row(y - 1), rows[y - 1], disparity.row(y), rows[y], width, max_step_px, kernels, runs);
  };

  parallelFor(threads, (height + kStripRows - 1) / kStripRows, [&](int strip) {
    const int y_begin = strip * kStripRows, y_end = std::min(height, y_begin + kStripRows);
    int next = y_begin * width;
    for (int y = y_begin; y < y_end; ++y) {
      const int first = next;
      next = appendRuns(disparity.row(y), width, max_step_px, kernels, runs, first);
      rows[y] = {first, next};
      if (y > y_begin) link(y);
    }
  });
  for (int y = kStripRows; y < height; y += kStripRows) link(y);

  parallelStrips(threads, height, kStripRows, [&](int y_begin, int y_end) {
    for (int y = y_begin; y < y_end; ++y)
      for (int i = rows[y].first; i < rows[y].last; ++i) {
        int root = i;
        while (runs[root].parent != root) root = runs[root].parent;  // read only: strips share the forest
        if (runs[root].size >= min_size_px) continue;
        std::fill(disparity.row(y) + runs[i].begin, disparity.row(y) + runs[i].end,
                  std::numeric_limits<float>::quiet_NaN());
        std::fill(state.row(y) + runs[i].begin, state.row(y) + runs[i].end,
                  static_cast<std::uint8_t>(PixelState::kSpeckle));
      }
  });
}

}  // namespace pomona
