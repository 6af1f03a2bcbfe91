#include "bench/speed/kernel_drivers.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/cpu.h"
#include "engine/sparse_stage.h"
#include "pomona/engine.h"
#include "pomona/pixel_state.h"
#include "pyramid/segment_match.h"
#include "pyramid/segmentation.h"

namespace pomona {
namespace {

template <typename T>
void copyPixels(ImageView<const T> from, Image<T>& to) {
  to.resize(from.width, from.height);
  for (int y = 0; y < from.height; ++y) std::copy_n(from.row(y), from.width, to.row(y));
}

ImageView<const float> viewOf(const cv::Mat& map) {
  return {map.ptr<float>(), map.cols, map.rows, static_cast<std::ptrdiff_t>(map.step1())};
}

void runInput(KernelMaterial& m, const KernelTables& tables) {
  m.made_gray.set(m.pair.left, m.pair.right, 1, tables.sgm);
}
void runDeepInput(KernelMaterial& m, const KernelTables& tables) {
  m.made_gray.set(m.deep_left, m.deep_right, 1, tables.sgm);
}

void runRows(KernelMaterial& m, const KernelTables& tables) {
  const MatchInput& in = m.input.views();
  m.row_check.measure(in.left, in.right, 0, m.size.disparities, tables.camera, 1);
  alignRows(in.right, {0.3f, 0, 0}, m.moved, tables.camera, 1);
  alignRows(std::as_const(m.right16).view(), {0.3f, 0, 0}, m.moved16, tables.camera, 1);
}

KernelDriver matchDriver(const char* name, const Options& o, SubpixelMethod subpixel,
                         std::function<void(const KernelMaterial&, MatchInput&, MatchOptions&)> change = {}) {
  const auto run = [o, subpixel, change](KernelMaterial& m, const KernelTables& tables) {
    MatchInput in = m.input.views();
    MatchOptions match{0, m.size.disparities, o.cost, o.aggregation, {subpixel, 0}};
    if (change) change(m, in, match);
    m.matcher.match(in, match, m.cost_table, tables.sgm, m.matched, m.scratch, 1);
  };
  return {name, 1, run, o.cost, o.aggregation};
}

std::vector<KernelDriver> matchDrivers() {
  const auto withCost = [](MatchingCost cost) {
    Options o;
    o.cost = {cost, 0};
    return o;
  };
  Options second;
  second.cost = second.second_pass.cost;
  second.aggregation = second.second_pass.aggregation;
  const auto addPrior = [second](const KernelMaterial& m, MatchInput& in, MatchOptions& match) {
    in.prior = m.dense.view();
    match.prior_weight = second.second_pass.weight;
    match.prior_reach_px = second.second_pass.reach_px;
  };
  const auto use16Bits = [](const KernelMaterial& m, MatchInput& in, MatchOptions&) {
    in.left16 = m.left16.view();
    in.right16 = m.right16.view();
  };
  return {matchDriver("census-5x5", Options::preset("fast"), SubpixelMethod::kEquiangular),
          matchDriver("census-5x5-16-bit", Options::preset("fast"), SubpixelMethod::kNone, use16Bits),
          matchDriver("census-9x7", withCost(MatchingCost::kCensus9x7), SubpixelMethod::kParabola),
          matchDriver("blended", Options(), SubpixelMethod::kFitted),
          matchDriver("second-pass", second, SubpixelMethod::kFitted, addPrior),
          matchDriver("table-wide-sums", Options::preset("paper"), SubpixelMethod::kParabola)};
}

void runChecks(KernelMaterial& m, const KernelTables& tables) {
  copyPixels<float>(m.dense.view(), m.disparity);
  m.state.resize(m.size.width, m.size.height);
  for (int y = 0; y < m.size.height; ++y)
    std::fill_n(m.state.row(y), m.size.width, static_cast<std::uint8_t>(PixelState::kMeasured));
  leftRightCheck(m.disparity.view(), m.state.view(), m.right_disparity.view(),
                 {m.options.validation.left_right_px, 0, m.size.disparities}, tables.filters, 1);
  removeSpeckles(m.disparity.view(), m.state.view(), m.options.validation.speckle_size_px,
                 m.options.validation.speckle_step_px, m.scratch, tables.filters, 1);
}

void runTrust(KernelMaterial& m, const KernelTables& tables) {
  MatchMaps& maps = m.trusted;
  maps.resize(m.size.width, m.size.height);
  copyPixels<float>(m.dense.view(), maps.disparity);
  copyPixels<float>(m.right_disparity.view(), maps.right_disparity);
  for (int y = 0; y < m.size.height; ++y) {
    std::fill_n(maps.margin(y), m.size.width, std::uint16_t{100});
    std::fill_n(maps.curvature(y), m.size.width, std::uint16_t{100});
    std::fill_n(maps.state.row(y), m.size.width, static_cast<std::uint8_t>(PixelState::kMeasured));
  }
  m.trust.estimate(maps, 8 * maximumCost(m.options.cost.cost), tables.filters, m.scratch, 1);
}

void runMedians(KernelMaterial& m, const KernelTables& tables) {
  for (int size : {3, 5})
    medianFilter(m.sparse_disparity.view(), m.disparity.view(), size, tables.filters, m.scratch, 1);
}

void runBilateral(KernelMaterial& m, const KernelTables& tables) {
  m.quarter_disparity.resize(m.quarter_sparse.width(), m.quarter_sparse.height());
  jointBilateral(m.quarter_sparse.view(), m.quarterGuide(),
                 {m.options.completion.sigma_space_px, m.options.completion.sigma_range},
                 m.quarter_disparity.view(), m.scratch, tables.filters, 1);
}

void runRefinement(KernelMaterial& m, const KernelTables& tables) {
  weightedMedian(m.dense.view(), m.guide(), m.disparity.view(), m.scratch, tables.filters, 1);
  for (int radius : {2, 3})
    refinePlanes(m.dense.view(), m.guide(), radius, m.disparity.view(), m.scratch, tables.filters, 1);
}

void runScaling(KernelMaterial& m, const KernelTables& tables) {
  const int width = m.quarter_dense.width(), height = m.quarter_dense.height();
  m.small.resize(3 * width, height);
  m.small16.resize(width, height);
  areaDownscale(m.guide(), m.small.view(), m.scratch, tables.pyramid, 1);
  areaDownscale(m.left16.view(), m.small16.view(), m.scratch, tables.pyramid, 1);
  bicubicUpscale(m.quarter_dense.view(), m.disparity.view(), m.scratch, tables.pyramid, 1);
}

void runFusion(KernelMaterial& m, const KernelTables& tables) {
  const int levels = m.options.completion.pyramid_levels;
  fuseEqual(m.dense.view(), m.dense.view(), levels, m.disparity.view(), m.scratch, tables.pyramid, 1);
}

void runFilling(KernelMaterial& m, const KernelTables& tables) {
  copyPixels<float>(m.sparse_disparity.view(), m.disparity);
  copyPixels<std::uint8_t>(m.sparse_state.view(), m.state);
  fillFromPlanes({.guide = m.guide(),
                  .left = m.input.views().left,
                  .right = m.input.views().right,
                  .right_disparity = m.right_disparity.view(),
                  .max_disparity = static_cast<float>(m.size.disparities - 1)},
                 m.disparity.view(), m.state.view(), m.scratch, tables.pyramid, 1);
  const auto nothing = [] { return ImageView<const float>(); };
  fillHoles({.guide = m.guide(), .right_disparity = m.right_disparity.view(), .coarse = nothing},
            m.disparity.view(), m.state.view(), m.scratch, tables.pyramid, 1);
}

/// Of gray images; runFilling() shows what colours take.
void runGraySegments(KernelMaterial& m, const KernelTables& tables) {
  const ImageView<const std::uint8_t> gray = m.input.views().left;
  const Arena::Scope scope(m.scratch);
  SortedEdges().build({gray.data, gray.width, gray.height, 1, gray.stride}, tables.pyramid, m.scratch, 1);
}

/// The whole view taken for one bare segment: real ones may be missing.
void runBareSegment(KernelMaterial& m, const KernelTables& tables) {
  constexpr int kFactor = 4;
  const int columns = scaledLength(m.size.width, kFactor), rows = scaledLength(m.size.height, kFactor);
  const std::vector<std::int32_t> labels(static_cast<std::size_t>(columns) * rows, 0);
  const MatchInput& in = m.input.views();
  const Arena::Scope scope(m.scratch);
  SegmentCells cells;
  cells.count(m.sparse_disparity.view(), m.sparse_state.view(), columns, rows, tables.pyramid, m.scratch, 1);
  cells.group(labels.data(), 1);
  SegmentMatch match;
  match.prepare(in.left, in.right, 0, m.size.disparities, tables.pyramid, m.scratch);
  const Segment whole{cells.segment(0), cells, labels.data()};
  match.announce(whole);
  match.readAnnounced(1);
  match.levelOf(whole);
}

}  // namespace

KernelMaterial::KernelMaterial(const FrameSize& frame_size, const BenchmarkInputs& inputs)
    : size(frame_size), pair(inputs.at(frame_size)) {
  options.num_disparities = size.disparities;
  input.set(pair.left, pair.right, 1);
  pair.left.convertTo(deep_left, CV_16U, 257);
  pair.right.convertTo(deep_right, CV_16U, 257);
  const MatchInput& in = input.views();
  for (auto [from, to] : {std::pair{in.left, &left16}, std::pair{in.right, &right16}}) {
    to->resize(from.width, from.height);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) to->row(y)[x] = static_cast<std::uint16_t>(257 * from.at(y, x));
  }
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; ++k) cost_table[256 * i + k] = static_cast<std::uint8_t>(std::abs(i - k) / 2);

  const Isa isa = usableIsas().back();
  SparseStage::Settings settings{
      .match = {0, size.disparities, options.cost, options.aggregation, options.winner},
      .validation = options.validation,
      .mutual_information = {},
      .mask = {},
      .isa = isa,
      .threads = 1,
      .scratch = &scratch};
  settings.validation.left_right_px = options.completion.seed_left_right_px;
  settings.validation.speckle_size_px = options.completion.seed_speckle_size_px;
  SparseStage sparse;
  StageClock untimed;
  sparse.run(in, settings, untimed);
  copyPixels<float>(sparse.maps().disparity.view(), sparse_disparity);
  copyPixels<float>(sparse.maps().right_disparity.view(), right_disparity);
  copyPixels<std::uint8_t>(sparse.maps().state.view(), sparse_state);
  copyPixels<float>(viewOf(StereoEngine(options).compute(pair.left, pair.right).disparity), dense);

  constexpr int kFactor = 4;
  const int width = scaledLength(size.width, kFactor), height = scaledLength(size.height, kFactor);
  quarter_guide.resize(3 * width, height);
  areaDownscale(guide(), quarter_guide.view(), scratch, pyramidKernels(isa), 1);
  for (auto [from, to] : {std::pair{&sparse_disparity, &quarter_sparse}, std::pair{&dense, &quarter_dense}}) {
    to->resize(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) to->row(y)[x] = from->row(kFactor * y)[kFactor * x] / kFactor;
  }
  disparity.resize(size.width, size.height);
}

std::vector<KernelDriver> kernelDrivers() {
  constexpr double kQuarter = 1.0 / 16;
  std::vector<KernelDriver> drivers = matchDrivers();
  drivers.insert(drivers.end(), {{"input", 1, runInput},
                                 {"input-16-bit", 1, runDeepInput},
                                 {"rows", 1, runRows},
                                 {"checks", 1, runChecks},
                                 {"trust", 1, runTrust},
                                 {"medians", 1, runMedians},
                                 {"bilateral-at-quarter", kQuarter, runBilateral},
                                 {"refinement", 1, runRefinement},
                                 {"scaling-by-4", 1, runScaling},
                                 {"fusion", 1, runFusion},
                                 {"filling", 1, runFilling},
                                 {"gray-segments", 1, runGraySegments},
                                 {"bare-segment", 1, runBareSegment}});
  return drivers;
}

}  // namespace pomona
