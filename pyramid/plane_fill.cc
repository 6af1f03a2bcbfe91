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
constexpr int kMinSegment_px = 100;
constexpr int kMinSources = 24;
constexpr float kMinInliers = 0.4f;  // per source

struct Division {
  float granularity;   // k of the full image
  float min_coverage;  // sources per pixel of a segment
};
constexpr std::array<Division, 3> kDivisions = {{{150, 0.3f}, {450, 0.1f}, {1350, 0.02f}}};

struct Pixel {
  int x, y;
};

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

  Pixel firstPixel(int cell) const { return {columns()[cell % width_], rows()[cell / width_]}; }
  int pixels(int cell) const {
    const int *x = columns() + cell % width_, *y = rows() + cell / width_;
    return (x[1] - x[0]) * (y[1] - y[0]);
  }
  template <typename F>
  void forEachPixel(int cell, F visit) const {
    const int *x_range = columns() + cell % width_, *y_range = rows() + cell / width_;
    for (int y = y_range[0]; y < y_range[1]; ++y)
      for (int x = x_range[0]; x < x_range[1]; ++x) visit(Pixel{x, y});
  }
  int sources(int cell) const { return scratch_.sources.row(cell / width_)[cell % width_]; }
  std::uint8_t& holes(int cell) const { return scratch_.holes.row(cell / width_)[cell % width_]; }

 private:
  const int* columns() const { return scratch_.column_begin.data(); }
  const int* rows() const { return scratch_.row_begin.data(); }

  // Pixel p belongs to cell p * cells / pixels.
  static void cut(int pixels, int cells, Buffer<int>& begin) {
    begin.resize(static_cast<std::size_t>(cells) + 1);
    for (int i = 0; i <= cells; ++i)
      begin[static_cast<std::size_t>(i)] = static_cast<int>((std::int64_t{i} * pixels + cells - 1) / cells);
  }

  void countRow(int row, ImageView<const float> disparity, ImageView<const std::uint8_t> state) {
    std::uint16_t* sums = scratch_.column_sums.row(row);  // sources, and holes times 256
    std::fill_n(sums, disparity.width, std::uint16_t{0});
    for (int y = rows()[row]; y < rows()[row + 1]; ++y) {
      const float* d = disparity.row(y);
      const std::uint8_t* s = state.row(y);
      for (int x = 0; x < disparity.width; ++x)
        sums[x] = static_cast<std::uint16_t>(sums[x] + isSource(d[x], s[x]) + 256 * isHole(d[x], s[x]));
    }
    for (int i = 0; i < width_; ++i) {
      int sum = 0;
      for (int x = columns()[i]; x < columns()[i + 1]; ++x) sum += sums[x];
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
  void fill(std::span<const int> segment, float min_coverage, std::uint32_t seed) const {
    int pixels = 0, sources = 0, holes = 0;
    for (const int cell : segment) {
      pixels += cells_.pixels(cell);
      sources += cells_.sources(cell);
      holes += cells_.holes(cell);
    }
    if (holes == 0 || sources < kMinSources ||
        static_cast<float>(sources) < min_coverage * static_cast<float>(pixels))
      return;
    const Pixel origin = cells_.firstPixel(segment[0]);
    const PlanePoints points = sample(segment, sources, origin);
    const PlaneFit fit = fitPlane(points, seed, kernels_);
    if (fit.inliers == 0 || static_cast<float>(fit.inliers) < kMinInliers * static_cast<float>(points.count))
      return;
    for (const int cell : segment)
      if (cells_.holes(cell) > 0) fillCell(cell, origin, fit);
  }

 private:
  // Sources at equal distances along the list of cells, as many as there is room for.
  PlanePoints sample(std::span<const int> segment, int sources, Pixel origin) const {
    PlanePoints points;
    const int step = (sources + PlanePoints::kCapacity - 1) / PlanePoints::kCapacity;
    int until_next = 0;
    for (const int cell : segment) {
      if (until_next >= cells_.sources(cell)) {
        until_next -= cells_.sources(cell);
        continue;
      }
      cells_.forEachPixel(cell, [&](Pixel p) {
        if (!isSource(disparity_.at(p.y, p.x), state_.at(p.y, p.x)) || until_next-- > 0) return;
        points.add(static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y),
                   disparity_.at(p.y, p.x));
        until_next = step - 1;
      });
    }
    return points;
  }

  void fillCell(int cell, Pixel origin, const PlaneFit& fit) const {
    cells_.forEachPixel(cell, [&](Pixel p) {
      if (!isHole(disparity_.at(p.y, p.x), state_.at(p.y, p.x))) return;
      // Beyond what supports it a plane soon leaves the surface: from there on it is taken to be level.
      const float e =
          std::clamp(fit.plane.at(static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y)),
                     fit.low - kPlaneTolerance_px, fit.high + kPlaneTolerance_px);
      if (!(e >= in_.min_disparity && e <= in_.max_disparity)) return;
      if (wouldHideFromRight(in_.right_disparity, p.y, p.x, e)) return;
      disparity_.at(p.y, p.x) = e;
      state_.at(p.y, p.x) = static_cast<std::uint8_t>(PixelState::kFilledPlane);
      --cells_.holes(cell);
    });
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
  parallelFor(threads, static_cast<int>(kDivisions.size()), [&](int i) {
    PlaneFillScratch::Segments& s = scratch.segments[static_cast<std::size_t>(i)];
    const float k = kDivisions[static_cast<std::size_t>(i)].granularity / scale;
    s.count = segment(scratch.edges, {k, kMinSegment_px / (in.scale * in.scale)}, s.labels, s.segmentation);
    listCells(s);
  });

  const PlaneFiller filler(in, cells, disparity, state, kernels);
  for (std::size_t i = 0; i < kDivisions.size(); ++i) {
    const PlaneFillScratch::Segments& s = scratch.segments[i];
    parallelStrips(threads, s.count, kMinSegmentsPerStrip, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const std::size_t n = static_cast<std::size_t>(j);
        filler.fill({s.cells.data() + s.begin[n], s.cells.data() + s.begin[n + 1]},
                    kDivisions[i].min_coverage, static_cast<std::uint32_t>(j));
      }
    });
  }
}

}  // namespace pomona
