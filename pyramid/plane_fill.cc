#include "pyramid/plane_fill.h"

#include <algorithm>
#include <cstdlib>

#include "core/parallel.h"
#include "pyramid/holes.h"
#include "pyramid/plane_fit.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 16;
constexpr int kMinSegmentsPerStrip = 8;
constexpr float kGranularity = 100;  // k of the full image
constexpr int kMinSegment_px = 50;
constexpr int kMinSources = 12;

struct Standard {
  float granularity;   // as a multiple of kGranularity
  float min_coverage;  // sources per pixel of the segment
  float min_inliers;   // per source
};
constexpr std::array<Standard, 3> kStandards = {{{1, 0.3f, 0.7f}, {3, 0.3f, 0.7f}, {9, 0.1f, 0.5f}}};

// The image's pixels in blocks, one for each pixel of the reduced image.
class Cells {
 public:
  Cells(PlaneFillScratch& scratch, int width, int height, int image_width, int image_height)
      : scratch_(scratch), width_(width), height_(height) {
    cut(image_width, width, scratch.column_begin);
    cut(image_height, height, scratch.row_begin);
  }

  // Counts sources and holes.
  void count(ImageView<const float> disparity, ImageView<const std::uint8_t> state, int threads) {
    scratch_.sources.resize(width_, height_);
    scratch_.holes.resize(width_, height_);
    scratch_.column_sums.resize(disparity.width, height_);
    parallelStrips(threads, height_, kMinRowsPerStrip, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) countRow(i, disparity, state);
    });
  }

  struct Block {
    int x_begin, x_end, y_begin, y_end;
    int pixels() const { return (x_end - x_begin) * (y_end - y_begin); }
  };
  Block block(int cell) const {
    const std::size_t i = static_cast<std::size_t>(cell % width_),
                      j = static_cast<std::size_t>(cell / width_);
    const Buffer<int>&x = scratch_.column_begin, &y = scratch_.row_begin;
    return {x[i], x[i + 1], y[j], y[j + 1]};
  }
  int sources(int cell) const { return scratch_.sources.row(cell / width_)[cell % width_]; }
  std::uint8_t& holes(int cell) const { return scratch_.holes.row(cell / width_)[cell % width_]; }

 private:
  // Pixel p belongs to cell p * cells / pixels.
  static void cut(int pixels, int cells, Buffer<int>& begin) {
    begin.resize(static_cast<std::size_t>(cells) + 1);
    for (int i = 0; i <= cells; ++i)
      begin[static_cast<std::size_t>(i)] = static_cast<int>((std::int64_t{i} * pixels + cells - 1) / cells);
  }

  void countRow(int row, ImageView<const float> disparity, ImageView<const std::uint8_t> state) {
    std::uint16_t* sums = scratch_.column_sums.row(row);  // sources, and holes times 256
    std::fill_n(sums, disparity.width, std::uint16_t{0});
    for (int y = scratch_.row_begin[static_cast<std::size_t>(row)];
         y < scratch_.row_begin[static_cast<std::size_t>(row) + 1]; ++y) {
      const float* d = disparity.row(y);
      const std::uint8_t* s = state.row(y);
      for (int x = 0; x < disparity.width; ++x)
        sums[x] = static_cast<std::uint16_t>(sums[x] + isSource(d[x], s[x]) + 256 * isHole(d[x], s[x]));
    }
    for (int i = 0; i < width_; ++i) {
      int sum = 0;
      for (int x = scratch_.column_begin[static_cast<std::size_t>(i)];
           x < scratch_.column_begin[static_cast<std::size_t>(i) + 1]; ++x)
        sum += sums[x];
      scratch_.sources.row(row)[i] = static_cast<std::uint8_t>(sum % 256);
      scratch_.holes.row(row)[i] = static_cast<std::uint8_t>(sum / 256);
    }
  }

  PlaneFillScratch& scratch_;
  int width_, height_;
};

// Counting sort of the cells by label.
void listCells(PlaneFillScratch::Segments& s) {
  const int width = s.labels.width(), height = s.labels.height();
  s.begin.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) +
                 2);  // whatever the count
  s.cells.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  int* next = s.begin.data() + 1;
  std::fill_n(s.begin.data(), s.count + 2, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ++next[s.labels.row(y)[x] + 1];
  for (int i = 0; i < s.count; ++i) next[i + 1] += next[i];
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      s.cells[static_cast<std::size_t>(next[s.labels.row(y)[x]]++)] = y * width + x;
}

class PlaneFiller {
 public:
  PlaneFiller(const PlaneFillInput& in, const Cells& cells, ImageView<float> disparity,
              ImageView<std::uint8_t> state, const PyramidKernels& kernels)
      : in_(in), cells_(cells), disparity_(disparity), state_(state), kernels_(kernels) {}

  // Reads and writes pixels of the segment only: segments may be filled in any order.
  void fill(std::span<const int> segment, std::uint32_t seed, const Standard& standard) const {
    int pixels = 0, sources = 0, holes = 0;
    for (const int cell : segment) {
      pixels += cells_.block(cell).pixels();
      sources += cells_.sources(cell);
      holes += cells_.holes(cell);
    }
    if (holes == 0 || sources < kMinSources ||
        static_cast<float>(sources) < standard.min_coverage * static_cast<float>(pixels))
      return;
    const Cells::Block first = cells_.block(segment[0]);
    const Origin origin{first.x_begin, first.y_begin};
    PlanePoints points;
    gather(segment, sources, origin, points);
    const PlaneFit fit = fitPlane(points, seed, kernels_);
    if (fit.inliers == 0 ||
        static_cast<float>(fit.inliers) < standard.min_inliers * static_cast<float>(points.count))
      return;
    for (const int cell : segment)
      if (cells_.holes(cell) > 0) fillCell(cell, origin, fit.plane);
  }

 private:
  struct Origin {
    int x, y;
  };

  // Sources at equal distances along the list of cells, as many as there is room for.
  void gather(std::span<const int> segment, int sources, Origin origin, PlanePoints& points) const {
    const int step = (sources + PlanePoints::kCapacity - 1) / PlanePoints::kCapacity;
    int until_next = 0;
    for (const int cell : segment) {
      if (until_next >= cells_.sources(cell)) {
        until_next -= cells_.sources(cell);
        continue;
      }
      const Cells::Block b = cells_.block(cell);
      for (int y = b.y_begin; y < b.y_end; ++y)
        for (int x = b.x_begin; x < b.x_end; ++x) {
          if (!isSource(disparity_.at(y, x), state_.at(y, x)) || until_next-- > 0) continue;
          points.add(static_cast<float>(x - origin.x), static_cast<float>(y - origin.y), disparity_.at(y, x));
          until_next = step - 1;
        }
    }
  }

  void fillCell(int cell, Origin origin, const DisparityPlane& plane) const {
    const Cells::Block b = cells_.block(cell);
    for (int y = b.y_begin; y < b.y_end; ++y)
      for (int x = b.x_begin; x < b.x_end; ++x) {
        if (!isHole(disparity_.at(y, x), state_.at(y, x))) continue;
        const float e = plane.at(static_cast<float>(x - origin.x), static_cast<float>(y - origin.y));
        if (!(e >= in_.min_disparity && e <= in_.max_disparity)) continue;
        if (wouldHideFromRight(in_.right_disparity, y, x, e)) continue;
        disparity_.at(y, x) = e;
        state_.at(y, x) = static_cast<std::uint8_t>(PixelState::kFilledPlane);
        --cells_.holes(cell);
      }
  }

  const PlaneFillInput& in_;
  const Cells& cells_;
  ImageView<float> disparity_;
  ImageView<std::uint8_t> state_;
  const PyramidKernels& kernels_;
};

}  // namespace

void fillFromPlanes(const PlaneFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
                    PlaneFillScratch& scratch, const PyramidKernels& kernels, int threads) {
  const int width = scaledLength(disparity.width, in.scale),
            height = scaledLength(disparity.height, in.scale);
  GuideView guide = in.guide;
  if (in.scale > 1) {
    areaDownscale(in.guide, scratch.reduced_guide, width, height, scratch.scale, kernels, threads);
    const ImageView<const std::uint8_t> v = scratch.reduced_guide.view();
    guide = {v.data, width, height, guide.channels, v.stride};
  }
  Cells cells(scratch, width, height, disparity.width, disparity.height);
  cells.count(disparity, state, threads);
  scratch.edges.build(guide, kernels, threads);
  const float scale = static_cast<float>(in.scale);
  parallelFor(threads, static_cast<int>(kStandards.size()), [&](int i) {
    PlaneFillScratch::Segments& s = scratch.segments[static_cast<std::size_t>(i)];
    const float k = kStandards[static_cast<std::size_t>(i)].granularity * kGranularity / scale;
    s.count = segment(scratch.edges, {k, kMinSegment_px / (in.scale * in.scale)}, s.labels, s.segmentation);
    listCells(s);
  });

  const PlaneFiller filler(in, cells, disparity, state, kernels);
  for (std::size_t i = 0; i < kStandards.size(); ++i) {
    const PlaneFillScratch::Segments& s = scratch.segments[i];
    parallelStrips(threads, s.count, kMinSegmentsPerStrip, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const std::size_t n = static_cast<std::size_t>(j);
        filler.fill({s.cells.data() + s.begin[n], s.cells.data() + s.begin[n + 1]},
                    static_cast<std::uint32_t>(j), kStandards[i]);
      }
    });
  }
}

}  // namespace pomona
