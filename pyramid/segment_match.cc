#include "pyramid/segment_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace pomona {
namespace {

using Cell = SegmentCells::Cell;
using Pixel = SegmentCells::Pixel;

constexpr int kMinRowsPerStrip = 16;
constexpr int kResidualLimit = 62;  // 2.5 gray values
constexpr int kEdge_px = 4;         // so far from other segments
constexpr int kFewestPixels = 1000;
constexpr int kMostPixels = 1 << 15;                  // more are sampled by rows: sums stay below 2^31
constexpr int kNear_px = 2;                           // disparities that share one peak
constexpr int kFewestOthers = 8;                      // disparities that tell how much scores spread
constexpr int kFewestOthersPart = 2;                  // and one in so many of the range
constexpr double kLeastHeight = 4, kLeastLead = 1.5;  // in deviations

void residualsOf(ImageView<const std::uint8_t> in, int y, const PyramidKernels& kernels, std::int8_t* out) {
  const std::uint8_t* rows[5];
  for (int i = 0; i < 5; ++i) rows[i] = in.row(std::clamp(y + i - 2, 0, in.height - 1));
  kernels.localResidual(rows, in.width, kResidualLimit, out);
}

}  // namespace

void SegmentMatch::prepare(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                           int min_disparity, int disparities, const PyramidKernels& kernels, Arena& arena) {
  kernels_ = &kernels;
  min_disparity_ = min_disparity;
  disparities_ = left.empty() ? 0 : disparities;
  if (left.empty()) return;
  const int width = left.width, last = min_disparity + disparities - 1;
  const int before = std::max(0, last), behind = std::max(0, -min_disparity);
  offset_ = before - last;
  left_view_ = left;
  right_view_ = right;
  left_ = arena.image<std::int8_t>(width, left.height);
  right_ = arena.image<std::int8_t>(before + width + behind, left.height);
  rows_ = arena.take<RowState>(static_cast<std::size_t>(left.height));
  std::fill_n(rows_, left.height, RowState::kUnread);
}

void SegmentMatch::announce(const Segment& segment) {
  if (disparities_ == 0 || innerPixels(segment) < kFewestPixels) return;
  const Cell last = segment.members.back();
  const int end = segment.cells.firstPixel(last).y + segment.cells.height(last);
  for (int y = segment.origin().y; y < end; ++y)
    if (rows_[y] == RowState::kUnread) rows_[y] = RowState::kAnnounced;
}

void SegmentMatch::readAnnounced(int threads) {
  if (disparities_ == 0) return;
  const int before = std::max(0, min_disparity_ + disparities_ - 1), behind = std::max(0, -min_disparity_);
  parallelStrips(threads, left_.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      if (rows_[y] != RowState::kAnnounced) continue;
      residualsOf(left_view_, y, *kernels_, left_.row(y));
      std::int8_t* to = right_.row(y);
      std::fill_n(to, before, std::int8_t{0});
      residualsOf(right_view_, y, *kernels_, to + before);
      std::fill_n(to + before + left_.width, behind, std::int8_t{0});
      rows_[y] = RowState::kRead;
    }
  });
}

template <typename F>
void SegmentMatch::forEachInnerCell(const Segment& segment, F visit) const {
  const int columns = segment.cells.columns(), rows = segment.cells.rows();
  const int reach = (kEdge_px * columns + left_.width - 1) / left_.width;
  const auto label = [&](int x, int y) {
    return segment.labels[static_cast<std::size_t>(std::clamp(y, 0, rows - 1)) * columns +
                          std::clamp(x, 0, columns - 1)];
  };
  const std::int32_t own = label(segment.members[0].x, segment.members[0].y);
  for (const Cell c : segment.members) {
    bool inner = true;
    for (int dy = -reach; dy <= reach && inner; dy += reach)
      for (int dx = -reach; dx <= reach; dx += reach) inner &= label(c.x + dx, c.y + dy) == own;
    if (inner) visit(c);
  }
}

int SegmentMatch::innerPixels(const Segment& segment) const {
  int pixels = 0;
  forEachInnerCell(segment, [&](Cell c) { pixels += segment.cells.width(c) * segment.cells.height(c); });
  return pixels;
}

/// visit(first pixel, count) for the rows of the inner cells, or for an even share of them if there are too
/// many.
template <typename F>
void SegmentMatch::forEachInnerRow(const Segment& segment, F visit) const {
  const int pixels = innerPixels(segment);
  if (pixels < kFewestPixels) return;
  const int step = (pixels + kMostPixels - 1) / kMostPixels;
  int rows = 0;
  forEachInnerCell(segment, [&](Cell c) {
    const Pixel first = segment.cells.firstPixel(c);
    for (int y = first.y; y < first.y + segment.cells.height(c); ++y)
      if (rows++ % step == 0) visit(Pixel{first.x, y}, segment.cells.width(c));
  });
}

std::optional<SegmentMatch::Level> SegmentMatch::levelOf(const Segment& segment) const {
  if (disparities_ == 0) return {};
  std::array<std::int32_t, kMostDisparities> products, squares;
  std::fill_n(products.begin(), disparities_, 0);
  std::fill_n(squares.begin(), disparities_, 0);
  forEachInnerRow(segment, [&](Pixel p, int count) {
    kernels_->correlate(left_.row(p.y) + p.x, rightOf(p.x, p.y), count, disparities_, products.data(),
                        squares.data());
  });
  // Where most of the segment would lie outside the right view, or meet edges there, scores say little.
  const int fewest = *std::max_element(squares.begin(), squares.begin() + disparities_) / 8;
  const auto isKnown = [&](int d) { return squares[disparities_ - 1 - d] > fewest; };
  const auto score = [&](int d) {
    const int k = disparities_ - 1 - d;
    return products[k] / std::sqrt(static_cast<double>(squares[k]));
  };
  int best = -1;
  for (int d = 0; d < disparities_; ++d)
    if (isKnown(d) && (best < 0 || score(d) > score(best))) best = d;
  if (best < 0) return {};

  double sum = 0, sum_of_squares = 0, second = 0;
  int others = 0;
  for (int d = 0; d < disparities_; ++d) {
    if (std::abs(d - best) <= kNear_px || !isKnown(d)) continue;
    second = others++ == 0 ? score(d) : std::max(second, score(d));
    sum += score(d);
    sum_of_squares += score(d) * score(d);
  }
  // The segment's own disparity may be among the unknown ones, or may be outside the right view.
  if (others < std::max(kFewestOthers, disparities_ / kFewestOthersPart)) return {};
  if (squares[disparities_ - 1 - best] < 4 * fewest) return {};
  const double mean = sum / others;
  const double deviation = std::sqrt(std::max(0.0, sum_of_squares / others - mean * mean));
  const double height = score(best) - mean, lead = score(best) - second;
  if (!(height >= kLeastHeight * deviation && lead >= kLeastLead * deviation)) return {};

  double offset = 0;
  if (best > 0 && best + 1 < disparities_ && isKnown(best - 1) && isKnown(best + 1)) {
    const double below = score(best) - score(best - 1), above = score(best) - score(best + 1);
    if (below + above > 0) offset = (below - above) / (2 * (below + above));
  }
  return Level{static_cast<float>(min_disparity_ + best + offset), score(best), deviation};
}

double SegmentMatch::scoreOf(const Segment& segment, const PlaneFit& fit) const {
  const Pixel origin = segment.origin();
  std::int64_t products = 0, squares = 0;
  forEachInnerRow(segment, [&](Pixel p, int count) {
    for (int x = p.x; x < p.x + count; ++x) {
      const int left = left_.row(p.y)[x];
      if (left == 0) continue;
      const float d = fit.at(static_cast<float>(x - origin.x), static_cast<float>(p.y - origin.y));
      const int index =
          std::clamp(static_cast<int>(std::floor(d + 0.5f)) - min_disparity_, 0, disparities_ - 1);
      const int right = rightOf(x, p.y)[disparities_ - 1 - index];
      products += left * right;
      squares += right * right;
    }
  });
  return squares == 0 ? 0 : static_cast<double>(products) / std::sqrt(static_cast<double>(squares));
}

}  // namespace pomona
