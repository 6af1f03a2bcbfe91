#include "bench/speed/kernels.h"

#include <benchmark/benchmark.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "bench/speed/kernel_clock.h"
#include "bench/speed/traffic.h"
#include "core/cpu.h"
#include "engine/input.h"
#include "engine/sparse_stage.h"
#include "filters/joint_bilateral.h"
#include "filters/plane_refine.h"
#include "filters/weighted_median.h"
#include "pomona/engine.h"
#include "pyramid/fusion.h"
#include "pyramid/hole_fill.h"
#include "pyramid/plane_fill.h"
#include "pyramid/scale.h"

namespace pomona {
namespace {

/// The tables of one instruction set, every kernel timed.
struct Tables {
  SgmKernels sgm;
  FilterKernels filters;
  PyramidKernels pyramid;

  explicit Tables(Isa isa) : sgm(sgmKernels(isa)), filters(filterKernels(isa)), pyramid(pyramidKernels(isa)) {
#define TIMED(table, kernel) table.kernel = timed<#kernel>(table.kernel)
    TIMED(sgm, census8), TIMED(sgm, census16), TIMED(sgm, sobel), TIMED(sgm, colorSteps);
    TIMED(sgm, censusCost), TIMED(sgm, tableCost), TIMED(sgm, blendedCost), TIMED(sgm, support);
    TIMED(sgm, prior), TIMED(sgm, aggregateFirst), TIMED(sgm, aggregateLast);
    TIMED(sgm, refine[0]), TIMED(sgm, refine[1]), TIMED(sgm, refine[2]), TIMED(sgm, refine[3]);
    TIMED(filters, median3x3), TIMED(filters, median5x5), TIMED(filters, jointBilateral);
    TIMED(filters, nearJumps), TIMED(filters, weightedMedian);
    TIMED(filters, refinePlanes[0]), TIMED(filters, refinePlanes[1]);
    TIMED(pyramid, accumulate8), TIMED(pyramid, accumulate16);
    TIMED(pyramid, cubicRow), TIMED(pyramid, cubicColumn);
    TIMED(pyramid, reduceRow), TIMED(pyramid, reduceColumn);
    TIMED(pyramid, expandRow), TIMED(pyramid, addExpandedColumn);
    TIMED(pyramid, average), TIMED(pyramid, blend), TIMED(pyramid, advanceRays);
    TIMED(pyramid, difference1), TIMED(pyramid, largestDifference3);
    TIMED(pyramid, countSourcesAndHoles), TIMED(pyramid, countNearPlane);
    TIMED(pyramid, packColors), TIMED(pyramid, gatherCandidates), TIMED(pyramid, candidateMedian);
#undef TIMED
  }
};

template <typename T>
void copyPixels(ImageView<const T> from, Image<T>& to) {
  to.resize(from.width, from.height);
  for (int y = 0; y < from.height; ++y) std::copy_n(from.row(y), from.width, to.row(y));
}

ImageView<const float> viewOf(const cv::Mat& map) {
  return {map.ptr<float>(), map.cols, map.rows, static_cast<std::ptrdiff_t>(map.step1())};
}

/// What the stages work on: the pair, and the maps that the stages before them make of it.
struct Material {
  Material(const FrameSize& frame_size, const BenchmarkInputs& inputs);

  GuideView guide() const { return input.views().guide; }
  GuideView quarterGuide() const {
    return {quarter_guide.row(0), quarter_sparse.width(), quarter_sparse.height(), 3,
            quarter_guide.view().stride};
  }

  FrameSize size;
  ImagePair pair;
  InputPair input;
  Options options;
  Image<std::uint16_t> left16, right16;
  SparseStage sparse;
  Image<float> dense, sparse_disparity;  // copies that in-place stages may not change
  Image<std::uint8_t> sparse_state;
  Image<float> right_disparity;
  Image<std::uint8_t> quarter_guide;
  Image<float> quarter_sparse, quarter_dense;

  MatchMaps matched;  // outputs and scratch of the stages
  SgmMatcher matcher;
  Image<float> disparity;
  Image<std::uint8_t> state;
  std::array<std::uint8_t, 65536> table;
};

Material::Material(const FrameSize& frame_size, const BenchmarkInputs& inputs)
    : size(frame_size), pair(inputs.at(frame_size)) {
  options.num_disparities = size.disparities;
  input.set(pair.left, pair.right, 1);
  const MatchInput& in = input.views();
  for (auto [from, to] : {std::pair{in.left, &left16}, std::pair{in.right, &right16}}) {
    to->resize(from.width, from.height);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) to->row(y)[x] = static_cast<std::uint16_t>(257 * from.at(y, x));
  }
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; ++k) table[256 * i + k] = static_cast<std::uint8_t>(std::abs(i - k) / 2);

  const Isa isa = usableIsas().back();
  StageClock untimed;
  sparse.run(in,
             {{0, size.disparities, options.cost, options.aggregation, options.winner},
              options.validation,
              {},
              {},
              isa,
              1},
             untimed);
  copyPixels<float>(sparse.maps().disparity.view(), sparse_disparity);
  copyPixels<float>(sparse.maps().right_disparity.view(), right_disparity);
  copyPixels<std::uint8_t>(sparse.maps().state.view(), sparse_state);
  copyPixels<float>(viewOf(StereoEngine(options).compute(pair.left, pair.right).disparity), dense);

  constexpr int kFactor = 4;
  const int width = scaledLength(size.width, kFactor), height = scaledLength(size.height, kFactor);
  ScaleScratch scratch;
  areaDownscale(guide(), quarter_guide, width, height, scratch, pyramidKernels(isa), 1);
  for (auto [from, to] : {std::pair{&sparse_disparity, &quarter_sparse}, std::pair{&dense, &quarter_dense}}) {
    to->resize(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) to->row(y)[x] = from->row(kFactor * y)[kFactor * x] / kFactor;
  }
  disparity.resize(size.width, size.height);
}

/// A stage that is run for its kernels' sake.
struct Driver {
  const char* name;
  double pixels = 1;  ///< that it works on, as a share of the frame's
  std::function<void(Material&, const Tables&)> run;
  CostOptions cost = {};  ///< of those that match
  AggregationOptions aggregation = {};
};

Driver matchDriver(const char* name, const Options& o, SubpixelMethod subpixel,
                   std::function<void(const Material&, MatchInput&, MatchOptions&)> change = {}) {
  const auto run = [o, subpixel, change](Material& m, const Tables& tables) {
    MatchInput in = m.input.views();
    MatchOptions match{0, m.size.disparities, o.cost, o.aggregation, {subpixel, 0}};
    if (change) change(m, in, match);
    m.matcher.match(in, match, m.table, tables.sgm, m.matched, 1);
  };
  return {name, 1, run, o.cost, o.aggregation};
}

std::vector<Driver> matchDrivers() {
  const auto withCost = [](MatchingCost cost) {
    Options o;
    o.cost = {cost, 0};
    return o;
  };
  Options second;
  second.cost = second.second_pass.cost;
  second.aggregation = second.second_pass.aggregation;
  const auto addPrior = [second](const Material& m, MatchInput& in, MatchOptions& match) {
    in.prior = m.dense.view();
    match.prior_weight = second.second_pass.weight;
    match.prior_reach_px = second.second_pass.reach_px;
  };
  const auto use16Bits = [](const Material& m, MatchInput& in, MatchOptions&) {
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

void runMedians(Material& m, const Tables& tables) {
  static MedianScratch scratch;
  for (int size : {3, 5})
    medianFilter(m.sparse_disparity.view(), m.disparity.view(), size, tables.filters, scratch, 1);
}

void runBilateral(Material& m, const Tables& tables) {
  static BilateralScratch scratch;
  static Image<float> out;
  out.resize(m.quarter_sparse.width(), m.quarter_sparse.height());
  jointBilateral(m.quarter_sparse.view(), m.quarterGuide(),
                 {m.options.completion.sigma_space_px, m.options.completion.sigma_range}, out.view(), scratch,
                 tables.filters, 1);
}

void runRefinement(Material& m, const Tables& tables) {
  static WeightedMedianScratch median;
  static PlaneRefineScratch planes;
  weightedMedian(m.dense.view(), m.guide(), m.disparity.view(), median, tables.filters, 1);
  for (int radius : {2, 3})
    refinePlanes(m.dense.view(), m.guide(), radius, m.disparity.view(), planes, tables.filters, 1);
}

void runScaling(Material& m, const Tables& tables) {
  static ScaleScratch scratch;
  static Image<std::uint8_t> small;
  static Image<std::uint16_t> small16;
  const int width = m.quarter_dense.width(), height = m.quarter_dense.height();
  areaDownscale(m.guide(), small, width, height, scratch, tables.pyramid, 1);
  areaDownscale(m.left16.view(), small16, width, height, scratch, tables.pyramid, 1);
  bicubicUpscale(m.quarter_dense.view(), m.disparity.view(), scratch, tables.pyramid, 1);
}

void runFusion(Material& m, const Tables& tables) {
  static FusionScratch scratch;
  static Image<float> weight;
  weight.resize(m.size.width, m.size.height);
  for (int y = 0; y < m.size.height; ++y) std::fill_n(weight.row(y), m.size.width, 0.5f);
  const int levels = m.options.completion.pyramid_levels;
  fuseEqual(m.dense.view(), m.dense.view(), levels, m.disparity.view(), scratch, tables.pyramid, 1);
  fuseWeighted(m.dense.view(), m.dense.view(), weight.view(), levels, m.disparity.view(), scratch,
               tables.pyramid, 1);
}

void runFilling(Material& m, const Tables& tables) {
  static PlaneFillScratch planes;
  static HoleFillScratch holes;
  copyPixels<float>(m.sparse_disparity.view(), m.disparity);
  copyPixels<std::uint8_t>(m.sparse_state.view(), m.state);
  fillFromPlanes({.guide = m.guide(),
                  .right_disparity = m.right_disparity.view(),
                  .max_disparity = static_cast<float>(m.size.disparities - 1)},
                 m.disparity.view(), m.state.view(), planes, tables.pyramid, 1);
  const auto nothing = [] { return ImageView<const float>(); };
  fillHoles({.guide = m.guide(), .right_disparity = m.right_disparity.view(), .coarse = nothing},
            m.disparity.view(), m.state.view(), holes, tables.pyramid, 1);
}

/// Of gray images; runFilling() shows what colours take.
void runGraySegments(Material& m, const Tables& tables) {
  static SortedEdges edges;
  const ImageView<const std::uint8_t> gray = m.input.views().left;
  edges.build({gray.data, gray.width, gray.height, 1, gray.stride}, tables.pyramid, 1);
}

/// What the clock itself adds to a call.
double clockNanoseconds() {
  constexpr int kCalls = 100000;
  auto* const nothing = timed<"nothing">(+[]() {});
  KernelTime& time = TimedKernel<"nothing", void>::time;
  time.nanoseconds = time.calls = 0;
  for (int i = 0; i < kCalls; ++i) nothing();
  return 1.0 * static_cast<double>(time.nanoseconds) / kCalls;
}

void measure(benchmark::State& state, const Driver& driver, Isa isa, Material& material) {
  const Tables tables(isa);
  const double clock_ns = clockNanoseconds();
  driver.run(material, tables);  // memory is allocated here
  for (KernelTime* time : kernelTimes()) time->nanoseconds = time->calls = 0;
  const auto netNanoseconds = [&](const KernelTime& time) {
    return std::max(0.0, static_cast<double>(time.nanoseconds) - clock_ns * static_cast<double>(time.calls));
  };
  const auto total = [&] {
    double sum = 0;
    for (const KernelTime* time : kernelTimes()) sum += netNanoseconds(*time);
    return sum;
  };
  for (auto _ : state) {
    const double before = total();
    driver.run(material, tables);
    state.SetIterationTime((total() - before) / 1e9);
  }
  const double pixels = driver.pixels * material.size.pixels() * static_cast<double>(state.iterations());
  for (const KernelTime* time : kernelTimes()) {
    if (time->calls == 0) continue;
    state.counters["kernel:" + std::string(time->name)] = netNanoseconds(*time) / pixels;
    const double bytes =
        kernelTraffic(time->name, driver.cost, driver.aggregation, material.size.disparities, isa);
    if (bytes > 0) state.counters["bytes:" + std::string(time->name)] = bytes;
  }
}

}  // namespace

std::vector<std::string> registerKernels(const FrameSize& size, const BenchmarkInputs& inputs) {
  constexpr double kQuarter = 1.0 / 16;
  std::vector<Driver> drivers = matchDrivers();
  drivers.insert(drivers.end(), {{"medians", 1, runMedians},
                                 {"bilateral-at-quarter", kQuarter, runBilateral},
                                 {"refinement", 1, runRefinement},
                                 {"scaling-by-4", 1, runScaling},
                                 {"fusion", 1, runFusion},
                                 {"filling", 1, runFilling},
                                 {"gray-segments", 1, runGraySegments}});
  const auto material = std::make_shared<std::unique_ptr<Material>>();  // made by the first that is run
  std::vector<std::string> names;
  for (const Driver& driver : drivers)
    for (Isa isa : usableIsas()) {
      names.push_back("kernel/" + std::string(driver.name) + "/" + std::string(name(isa)) + "/" +
                      size.name());
      benchmark::RegisterBenchmark(names.back().c_str(),
                                   [=, &inputs](benchmark::State& state) {
                                     if (!*material) *material = std::make_unique<Material>(size, inputs);
                                     measure(state, driver, isa, **material);
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    }
  return names;
}

}  // namespace pomona
