#include "camera/row_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <utility>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kColumns = 16, kRows = 10;  // one point from each cell of this grid
constexpr int kBlock = 8;                 // side of the blocks compared there

using Bytes = ImageView<const std::uint8_t>;

struct Place {
  float x, y;
};
struct Match {
  Place left, right;  // pixels of the given views
};

int absoluteDifference(Bytes a, int ax, int ay, Bytes b, int bx, int by) {
  int sum = 0;
  for (int row = 0; row < kBlock; ++row) {
    const std::uint8_t* p = a.row(ay - kBlock / 2 + row) + ax - kBlock / 2;
    const std::uint8_t* q = b.row(by - kBlock / 2 + row) + bx - kBlock / 2;
    for (int i = 0; i < kBlock; ++i) sum += std::abs(p[i] - q[i]);
  }
  return sum;
}

// How well a block tells its place: the weaker one of its changes along x and along y, none of which counts
// for much by itself, lest points gather at hot pixels.
int texture(Bytes view, int x, int y) {
  constexpr int kMostOfOne = 40;
  int along_x = 0, along_y = 0;
  for (int row = y - 3; row < y + 3; ++row) {
    const std::uint8_t *p = view.row(row), *below = view.row(row + 1);
    for (int i = x - 3; i < x + 3; ++i) {
      along_x += std::min(std::abs(p[i + 1] - p[i]), kMostOfOne);
      along_y += std::min(std::abs(below[i] - p[i]), kMostOfOne);
    }
  }
  return std::min(along_x, along_y);
}

// The point with the most texture in a cell of the grid, at least `margin` from the border; false if none has
// any.
bool findTexture(Bytes view, int cell, int margin, int& x, int& y) {
  constexpr int kStep = 4, kLeastTexture = 80;
  const int column = cell % kColumns, row = cell / kColumns, w = view.width, h = view.height;
  int best = kLeastTexture;
  const int x_begin = std::max(margin, column * w / kColumns),
            x_end = std::min(w - margin, (column + 1) * w / kColumns);
  const int y_begin = std::max(margin, row * h / kRows), y_end = std::min(h - margin, (row + 1) * h / kRows);
  for (int py = y_begin; py < y_end; py += kStep)
    for (int px = x_begin; px < x_end; px += kStep)
      if (const int t = texture(view, px, py); t > best) best = t, x = px, y = py;
  return best > kLeastTexture;
}

struct Range {
  int begin, end;
};

// The best place in the right view, unless another disparity is about as good.
bool search(Bytes left, Bytes right, int x, int y, Range disparities, int reach, int& best_x, int& best_y) {
  const Range columns{std::max(kBlock / 2, x - disparities.end + 1),
                      std::min(right.width - kBlock / 2, x - disparities.begin + 1)};
  if (columns.end - columns.begin < 1) return false;
  std::array<int, 1024> cost_at;  // of the best row, by column: disparities of a reduced view are few
  const int count = std::min<int>(columns.end - columns.begin, cost_at.size());
  int best = std::numeric_limits<int>::max();
  for (int i = 0; i < count; ++i) {
    int lowest = std::numeric_limits<int>::max();
    for (int dy = -reach; dy <= reach; ++dy) {
      const int cost = absoluteDifference(left, x, y, right, columns.begin + i, y + dy);
      lowest = std::min(lowest, cost);
      if (cost < best) best = cost, best_x = columns.begin + i, best_y = y + dy;
    }
    cost_at[static_cast<std::size_t>(i)] = lowest;
  }
  constexpr int kNeighbours = 2, kWorstCost = 12 * kBlock * kBlock;
  for (int i = 0; i < count; ++i)
    if (std::abs(columns.begin + i - best_x) > kNeighbours &&
        4 * best > 3 * cost_at[static_cast<std::size_t>(i)])
      return false;
  return best < kWorstCost;
}

float sample(Bytes view, float x, float y) {
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
  const std::uint8_t *p = view.row(iy) + ix, *below = view.row(iy + 1) + ix;
  return (static_cast<float>(p[0]) * (1 - fx) + static_cast<float>(p[1]) * fx) * (1 - fy) +
         (static_cast<float>(below[0]) * (1 - fx) + static_cast<float>(below[1]) * fx) * fy;
}

// Moves `place` in the right view to where it looks like the left view around (x, y), brightness and contrast
// aside. False if that does not settle, leads away, or leaves the view.
bool settle(Bytes left, Bytes right, int x, int y, Place& place) {
  constexpr int kRadius = 5, kSide = 2 * kRadius + 1, kMostSteps = 5;
  constexpr float kFarthest = 3, kSettled = 0.03f, kLeastTexture = 8 * kSide * kSide;
  constexpr float kMostOfOne = 0.25f;  // of the texture: no place may hang on a hot pixel
  if (x < kRadius + 1 || y < kRadius + 1 || x + kRadius + 1 >= left.width || y + kRadius + 1 >= left.height)
    return false;
  std::array<float, kSide * kSide> value, seen, gx, gy;
  float xx = 0, xy = 0, yy = 0, mean = 0, mean_x = 0, mean_y = 0, largest_xx = 0, largest_yy = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int px = x - kRadius + i % kSide, py = y - kRadius + i / kSide;
    const auto k = static_cast<std::size_t>(i);
    value[k] = left.at(py, px);
    gx[k] = static_cast<float>(left.at(py, px + 1) - left.at(py, px - 1)) / 2;
    gy[k] = static_cast<float>(left.at(py + 1, px) - left.at(py - 1, px)) / 2;
    mean += value[k], mean_x += gx[k], mean_y += gy[k];
  }
  constexpr float kCount = kSide * kSide;
  mean /= kCount, mean_x /= kCount, mean_y /= kCount;
  float spread = 0;
  for (float& v : value) v -= mean, spread += v * v;
  for (std::size_t k = 0; k < gx.size(); ++k) {  // gradients of the brightness above its mean
    gx[k] -= mean_x, gy[k] -= mean_y;
    xx += gx[k] * gx[k], xy += gx[k] * gy[k], yy += gy[k] * gy[k];
    largest_xx = std::max(largest_xx, gx[k] * gx[k]), largest_yy = std::max(largest_yy, gy[k] * gy[k]);
  }
  const float determinant = xx * yy - xy * xy;
  if (!(yy > kLeastTexture && xx > kLeastTexture && determinant > 0.1f * xx * yy)) return false;
  if (largest_xx > kMostOfOne * xx || largest_yy > kMostOfOne * yy) return false;

  const Place begin = place;
  for (int step = 0; step < kMostSteps; ++step) {
    const float low = kRadius, right_end = static_cast<float>(right.width - kRadius - 2),
                bottom_end = static_cast<float>(right.height - kRadius - 2);
    if (!(place.x >= low && place.y >= low && place.x <= right_end && place.y <= bottom_end)) return false;
    float seen_mean = 0, seen_spread = 0, ex = 0, ey = 0;
    for (int i = 0; i < kSide * kSide; ++i)
      seen_mean += seen[static_cast<std::size_t>(i)] =
          sample(right, place.x + static_cast<float>(i % kSide - kRadius),
                 place.y + static_cast<float>(i / kSide - kRadius));
    seen_mean /= kCount;
    for (float& v : seen) v -= seen_mean, seen_spread += v * v;
    if (!(seen_spread > 0)) return false;
    const float gain = std::sqrt(spread / seen_spread);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      ex += gx[k] * (value[k] - gain * seen[k]);
      ey += gy[k] * (value[k] - gain * seen[k]);
    }
    const float dx = (yy * ex - xy * ey) / determinant, dy = (xx * ey - xy * ex) / determinant;
    place.x += dx, place.y += dy;
    if (std::abs(place.x - begin.x) > kFarthest || std::abs(place.y - begin.y) > kFarthest) return false;
    if (std::abs(dx) < kSettled && std::abs(dy) < kSettled) return true;
  }
  return false;
}

// A pair, and what it looks like reduced.
struct ReducedPair {
  Bytes left, right;
  Bytes left_coarse, right_coarse, left_contrast, right_contrast;
  int scale;
  int lower;  // where the rows of the reduced right view begin, in the view
};

std::optional<Match> matchIn(int cell, const ReducedPair& pair, Range disparities, int reach) {
  int x = 0, y = 0, right_x = 0, right_y = 0;
  if (!findTexture(pair.left_contrast, cell, kBlock / 2 + reach, x, y)) return {};
  if (!search(pair.left_contrast, pair.right_contrast, x, y, disparities, reach, right_x, right_y)) return {};
  Place place{static_cast<float>(right_x), static_cast<float>(right_y)};
  if (!settle(pair.left_coarse, pair.right_coarse, x, y, place)) return {};
  // The centre of a reduced pixel lies between full ones: take the one above and to the left of it.
  const int scale = pair.scale, full_x = x * scale + (scale - 1) / 2, full_y = y * scale + (scale - 1) / 2;
  const auto s = static_cast<float>(scale);
  Place full{
      static_cast<float>(full_x) + s * (place.x - static_cast<float>(x)),
      static_cast<float>(full_y) + s * (place.y - static_cast<float>(y)) + static_cast<float>(pair.lower)};
  if (!settle(pair.left, pair.right, full_x, full_y, full)) return {};
  return Match{{static_cast<float>(full_x), static_cast<float>(full_y)}, full};
}

// The plane that fits most points: least squares, with weights that fade out for those far off, which are
// mismatches.
RowOffsetPlane fitPlane(std::span<const Match> matches, int width, int height, float median_px) {
  RowOffsetPlane plane{median_px, 0, 0};
  for (const double scale_px : {4.0, 2.0, 1.0, 0.5, 0.5}) {
    // A little stiffness, so that points in one part of the image don't swing the rest.
    cv::Matx33d a = cv::Matx33d::diag({0, 1, 1});
    cv::Vec3d b(0, 0, 0);
    for (const Match& m : matches) {
      const cv::Vec3d row(1, 2.0 * m.left.x / width - 1, 2.0 * m.left.y / height - 1);
      const double dy = m.right.y - m.left.y,
                   off = (dy - plane.at(m.left.x, m.left.y, width, height)) / scale_px;
      const double weight = 1 / ((1 + off * off) * (1 + off * off));
      a += weight * row * row.t();
      b += weight * dy * row;
    }
    const cv::Vec3d c = a.solve(b, cv::DECOMP_CHOLESKY);
    plane = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
  }
  return plane;
}

float medianOf(std::span<float> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

RowOffsets summary(std::span<const Match> matches, int width, int height) {
  constexpr float kAgree_px = 1;
  constexpr std::size_t kFewestAgreeing = kFewestRowPoints / 2;
  const int count = static_cast<int>(matches.size());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RowOffsets unknown{nan, nan, count, {nan, nan, nan}, nan};
  if (count < kFewestRowPoints) return unknown;
  std::array<float, kColumns * kRows> values;
  const std::span<float> all(values.data(), matches.size());
  const auto offset = [](const Match& m) { return m.right.y - m.left.y; };
  std::transform(matches.begin(), matches.end(), all.begin(), offset);
  const RowOffsetPlane plane = fitPlane(matches, width, height, medianOf(all));
  const auto off = [&](const Match& m) {
    return std::abs(offset(m) - static_cast<float>(plane.at(m.left.x, m.left.y, width, height)));
  };
  std::size_t agreeing = 0;
  for (const Match& m : matches)
    if (off(m) < kAgree_px) values[agreeing++] = offset(m);
  if (agreeing < kFewestAgreeing) return unknown;
  const float median = medianOf(all.first(agreeing));
  std::transform(matches.begin(), matches.end(), all.begin(), off);
  const float worst = std::abs(plane.center_px) + std::abs(plane.slope_x_px) + std::abs(plane.slope_y_px);
  return {median, worst, count, plane, medianOf(all)};
}

// Whether reduced rows of the one view may lie halfway between those of the other, so that the same things
// look different there: by the offset, or because points are few or disagree.
bool mayLieHalfway(const RowOffsets& rows, int scale) {
  constexpr float kMostScatter_px = 0.25f;
  const float reduced_rows = rows.median_px / static_cast<float>(scale);
  return !(rows.scatter_px <= kMostScatter_px && std::abs(reduced_rows - std::round(reduced_rows)) < 0.25f);
}

}  // namespace

void RowCheck::reduce(ImageView<const std::uint8_t> in, int scale, int lower, View& view,
                      const CameraKernels& kernels, int threads) {
  constexpr int kFewestRows = 32;
  const int width = in.width / scale, height = in.height / scale;
  view.coarse.resize(width, height);
  view.contrast.resize(width, height);
  parallelStrips(threads, height, kFewestRows, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      kernels.reduceBlocks(in.row(std::min(y * scale + lower, in.height - scale)), in.stride, scale, width,
                           view.coarse.row(y));
  });
  parallelStrips(threads, height, kFewestRows, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint8_t *above = view.coarse.row(std::max(0, y - kContrastReach)),
                         *below = view.coarse.row(std::min(height - 1, y + kContrastReach));
      kernels.contrast(above, view.coarse.row(y), below, width, view.contrast.row(y));
    }
  });
}

RowOffsets RowCheck::measure(Bytes left, Bytes right, int min_disparity, int num_disparities,
                             const CameraKernels& kernels, int threads, int reach_px) {
  // Reduced rows of the right view begin `lower` full ones below those of the left one.
  const auto measureReducedBy = [&](int scale, int lower) {
    reduce(left, scale, 0, left_, kernels, threads);
    reduce(right, scale, lower, right_, kernels, threads);
    const auto view = [](const Image<std::uint8_t>& image) { return image.view(); };
    const ReducedPair pair{
        left,  right, view(left_.coarse), view(right_.coarse), view(left_.contrast), view(right_.contrast),
        scale, lower};
    const Range disparities{min_disparity / scale - 1, (min_disparity + num_disparities) / scale + 2};
    std::array<std::optional<Match>, kColumns * kRows> found;
    parallelFor(threads, kRows, [&](int row) {
      for (int cell = row * kColumns; cell < (row + 1) * kColumns; ++cell)
        found[static_cast<std::size_t>(cell)] =
            matchIn(cell, pair, disparities, std::max(1, reach_px / scale));
    });
    std::array<Match, kColumns * kRows> matches;
    std::size_t count = 0;
    for (const std::optional<Match>& match : found)
      if (match) matches[count++] = *match;
    return summary(std::span<const Match>(matches.data(), count), left.width, left.height);
  };
  int scale = left.width >= 800 ? 4 : left.width >= 400 ? 2 : 1;
  RowOffsets rows = measureReducedBy(scale, 0);
  // Fine texture is lost where it is reduced, or looks different where it lies half a reduced row off. Not
  // reduced at all, hot pixels would mislead.
  if (rows.points < kFewestRowPoints && scale > 2) rows = measureReducedBy(scale /= 2, 0);
  if (scale > 1 && mayLieHalfway(rows, scale)) {
    const RowOffsets halfway = measureReducedBy(scale, scale / 2);
    // Not for a few more: those may be wrong.
    if (2 * halfway.points > 3 * rows.points) rows = halfway;
  }
  return rows;
}

}  // namespace pomona
