#include "bench/speed/stages.h"

#include <benchmark/benchmark.h>

#include <functional>

#include "core/cpu.h"
#include "engine/coarse_stage.h"
#include "engine/input.h"
#include "engine/stage_clock.h"
#include "pomona/engine.h"

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
  engine.compute(pair.left, pair.right);  // memory is allocated here
  for (auto _ : state) count(state, engine.compute(pair.left, pair.right).timings);
}

/// SgmMatcher::match() in pieces, and the coarse maps.
struct MatchingParts {
  InputPair input;
  CensusTransform<std::uint8_t> census;
  SobelFilter sobel;
  struct {
    CensusPlanes census;
    Image<std::uint8_t> sobel;
  } views[2];
  ColorSteps steps;
  MatchingCostRows cost;
  Aggregator aggregator;
  CoarseStage coarse;

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
  MatchingCostRows::Features features[2];
  for (int i = 0; i < 2; ++i) {
    census.compute(i == 0 ? in.left : in.right, o.cost.cost, views[i].census, kernels, threads);
    features[i] = {&views[i].census, {}, i == 0 ? in.left : in.right};
  }
  clock.lap("census");
  if (blended) {
    for (int i = 0; i < 2; ++i) {
      sobel.compute(features[i].gray, views[i].sobel, kernels, threads);
      features[i].sobel = views[i].sobel.view();
    }
    clock.lap("Sobel");
  }
  steps.compute(in.guide, kernels, threads);
  clock.lap("colour steps");
  const DisparityRange range = makeRange(o.min_disparity, o.num_disparities, kernels);
  const auto prepare = blended ? &MatchingCostRows::prepareBlended : &MatchingCostRows::prepareCensus;
  (cost.*prepare)(features[0], features[1], maximumCost(o.cost.cost), range, kernels, threads);
  clock.lap("layout of the right features");
  cost.prepareSupport(steps, o.cost.support_color_step, threads);
  if (o.cost.support_color_step > 0) clock.lap("support arms");
  const auto drop = [](int, const WinnerRow&) {};
  aggregator.run(cost, steps, o.aggregation, MemoryMode::kSpeed, kernels, drop, threads);
  clock.lap("cost and aggregation");

  const SparseStage::Settings settings{
      .match = {o.min_disparity, o.num_disparities, o.cost, o.aggregation, o.winner},
      .validation = o.validation,
      .mutual_information = {},
      .mask = {},
      .isa = isa,
      .threads = threads};
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
  frame();
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
