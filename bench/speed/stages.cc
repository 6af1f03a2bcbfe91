#include "bench/speed/stages.h"

#include <benchmark/benchmark.h>

#include <functional>

#include "core/cpu.h"
#include "engine/coarse_stage.h"
#include "engine/input.h"
#include "engine/stage_clock.h"
#include "pomona/engine.h"
#include "sgm/aggregation.h"
#include "sgm/census.h"
#include "sgm/sobel.h"

namespace pomona {
namespace {

Options denseOptions(const char* preset, const FrameSize& size, int threads) {
  Options options = Options::preset(preset);
  options.num_disparities = size.disparities;
  options.threads = threads;
  return options;
}

/// Counts every stage's mean time; a stage that runs twice in a frame counts with both runs.
void count(benchmark::State& state, const std::vector<StageTiming>& timings) {
  using benchmark::Counter;
  for (const StageTiming& t : timings) {
    Counter& counter = state.counters["stage:" + std::string(t.stage)];
    counter.flags = Counter::kAvgIterations;
    counter.value += t.milliseconds;
  }
}

void measurePreset(benchmark::State& state, const Options& options, const ImagePair& pair) {
  StereoEngine engine(options);
  for (int i = 0; i < kWarmUpFrames; ++i) engine.compute(pair.left, pair.right);
  for (auto _ : state) count(state, engine.compute(pair.left, pair.right).timings);
}

/// SgmMatcher::match() in pieces, and the coarse maps.
struct MatchingParts {
  InputPair input;
  MatchingCostRows cost;
  CoarseStage coarse;
  Arena scratch;

  void run(const Options& o, const ImagePair& pair, StageClock& clock);
};

void MatchingParts::run(const Options& o, const ImagePair& pair, StageClock& clock) {
  const Isa isa = chooseIsa("");
  const SgmKernels& kernels = sgmKernels(isa);
  const int threads = o.threads;
  const bool blended = o.cost.cost == MatchingCost::kBlended;
  input.set(pair.left, pair.right, threads);
  clock.lap("input");
  const MatchInput& in = input.views();
  const Arena::Scope scope(scratch);
  CensusPlanes census[2];
  MatchingCostRows::Features features[2];
  for (int i = 0; i < 2; ++i) {
    features[i].gray = i == 0 ? in.left : in.right;
    census[i] = computeCensus(features[i].gray, o.cost.cost, kernels, scratch, threads);
    features[i].census = &census[i];
  }
  clock.lap("census");
  if (blended) {
    for (auto& view : features) view.sobel = computeSobel(view.gray, kernels, scratch, threads);
    clock.lap("Sobel");
  }
  const ColorSteps steps(in.guide, kernels);
  const DisparityRange range = makeRange(o.min_disparity, o.num_disparities, kernels);
  const auto start = blended ? &MatchingCostRows::startBlended : &MatchingCostRows::startCensus;
  (cost.*start)(features[0], maximumCost(o.cost.cost), range, kernels, scratch);
  cost.setRight(features[1], threads);
  clock.lap("layout of the right features");
  cost.prepareSupport(steps, o.cost.support_color_step, scratch, threads);
  if (o.cost.support_color_step > 0) clock.lap("support arms");
  const auto drop = [](int, const WinnerRow&) {};
  aggregate(cost, steps, o.aggregation, MemoryMode::kSpeed, kernels, drop, scratch, threads);
  clock.lap("cost and aggregation");

  const SparseStage::Settings settings{
      .match = {o.min_disparity, o.num_disparities, o.cost, o.aggregation, o.winner},
      .validation = o.validation,
      .mutual_information = {},
      .mask = {},
      .isa = isa,
      .threads = threads,
      .scratch = &scratch};
  coarse.run(in, settings, o.completion);
  clock.lap("coarse maps (if needed)");
}

void measureParts(benchmark::State& state, const Options& options, const ImagePair& pair) {
  MatchingParts parts;
  std::vector<StageTiming> timings;
  const auto frame = [&] {
    StageClock clock(timings);
    parts.run(options, pair, clock);
  };
  for (int i = 0; i < kWarmUpFrames; ++i) frame();
  for (auto _ : state) {
    frame();
    count(state, timings);
  }
}

}  // namespace

std::vector<std::string> registerStages(const FrameSize& size, const BenchmarkInputs& inputs) {
  std::vector<std::string> names;
  const auto add = [&](const char* what, const char* preset, int threads, auto measure) {
    const Options options = denseOptions(preset, size, threads);
    names.push_back(std::string("stage/") + what + "/" + preset + "/" + size.name() + "/t" +
                    std::to_string(threads));
    benchmark::RegisterBenchmark(
        names.back().c_str(),
        [=, &inputs](benchmark::State& state) { measure(state, options, inputs.at(size)); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  for (int threads : {1, 2}) {
    for (const char* preset : {"fast", "balanced", "quality", "paper"})
      add("frame", preset, threads, measurePreset);
    for (const char* preset : {"fast", "balanced"}) add("parts", preset, threads, measureParts);
  }
  return names;
}

}  // namespace pomona
