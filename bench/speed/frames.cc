#include "bench/speed/frames.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "baselines/method.h"
#include "core/cpu.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

std::string caseName(const std::string& method, const char* variant, const FrameSize& size, int threads) {
  return "frame/" + method + "/" + variant + "/" + size.name() + "/t" + std::to_string(threads);
}

/// `preset` may be followed by what is forced: "-8paths", "-avx2" or "-low" memory.
FrameCase presetCase(const std::string& preset, OutputMode mode, const FrameSize& size, int threads) {
  Options options = Options::preset(preset.substr(0, preset.find('-')));
  options.num_disparities = size.disparities;
  options.mode = mode;
  options.threads = threads;
  if (preset.ends_with("-8paths")) options.aggregation = {8, 5, 39, 10, PenaltyAdaptation::kSoftIntensity};
  if (preset.ends_with("-avx2")) options.isa = "avx2";
  if (preset.ends_with("-low")) options.memory = MemoryMode::kLow;
  return {caseName(preset, mode == OutputMode::kDense ? "dense" : "sparse", size, threads),
          size,
          threads,
          frameTraffic(options, size.height, size.pixels()),
          true,
          [options](const ImagePair& pair) {
            cv::setNumThreads(options.threads);
            const auto engine = std::make_shared<StereoEngine>(options);
            return [engine, &pair] { engine->compute(pair.left, pair.right); };
          }};
}

FrameCase peerCase(const std::string& method, bool raw, const FrameSize& size, int threads) {
  const MethodOptions options{.num_disparities = size.disparities, .mode = OutputMode::kSparse, .raw = raw};
  return {caseName(method, raw ? "raw" : "checked", size, threads),
          size,
          threads,
          {},
          false,
          [method, options, threads](const ImagePair& pair) {
            cv::setNumThreads(threads);
            const std::shared_ptr<Method> matcher = makeMethod(method);
            cv::Mat left, right;  // gray is all that they use, so they need not pay for making it
            cv::cvtColor(pair.left, left, cv::COLOR_BGR2GRAY);
            cv::cvtColor(pair.right, right, cv::COLOR_BGR2GRAY);
            return [=] { matcher->run(left, right, options); };
          }};
}

bool hasBetterThanAvx2() {
  const std::vector<Isa>& isas = usableIsas();
  return std::count(isas.begin(), isas.end(), Isa::kAvx2) > 0 && chooseIsa("") == Isa::kAvx512;
}

void measure(benchmark::State& state, const FrameCase& frame_case, const BenchmarkInputs& inputs) {
  const ImagePair pair = inputs.at(frame_case.size);
  const FrameCase::Frame frame = frame_case.prepare(pair);
  for (int i = 0; frame_case.keeps_memory && i < kWarmUpFrames; ++i) frame();
  for (auto _ : state) frame();

  using benchmark::Counter;
  constexpr auto kRate = Counter::kIsIterationInvariantRate;
  const auto time_of = kRate | Counter::kInvert;
  const double megapixels = frame_case.size.pixels() / 1e6;
  const double mega_disparities = megapixels * frame_case.size.disparities;
  state.counters["fps"] = Counter(1, kRate);
  state.counters["MDE_per_s"] = Counter(mega_disparities, kRate);
  state.counters["s_per_MP"] = Counter(megapixels, time_of);
  state.counters["s_per_GD"] = Counter(mega_disparities / 1e3, time_of);
  if (frame_case.traffic.memory > 0) {
    state.counters["memory_B_per_px"] = frame_case.traffic.memory;
    state.counters["rows_B_per_px"] = frame_case.traffic.rows;
  }
}

}  // namespace

std::vector<FrameCase> frameCases(std::span<const FrameSize> sizes) {
  std::vector<FrameCase> cases;
  for (const FrameSize& size : sizes)
    for (int threads : {1, 2}) {
      for (const char* preset : {"fast", "balanced", "quality", "paper"})
        for (OutputMode mode : {OutputMode::kSparse, OutputMode::kDense})
          if (std::string(preset) != "paper" || size.height == 720)
            cases.push_back(presetCase(preset, mode, size, threads));
      cases.push_back(presetCase("fast-8paths", OutputMode::kSparse, size, threads));
      if (hasBetterThanAvx2()) cases.push_back(presetCase("fast-avx2", OutputMode::kSparse, size, threads));
      for (OutputMode mode : {OutputMode::kSparse, OutputMode::kDense})
        cases.push_back(presetCase("fast-low", mode, size, threads));
      for (const char* peer : {"opencv-bm", "opencv-sgbm", "opencv-3way", "opencv-hh", "opencv-hh4"})
        for (bool raw : {false, true}) cases.push_back(peerCase(peer, raw, size, threads));
    }
  return cases;
}

const FrameCase& findCase(std::span<const FrameCase> cases, const std::string& name) {
  for (const FrameCase& c : cases)
    if (c.name == name) return c;
  throw std::invalid_argument("no frame is called \"" + name + "\" (--list names them)");
}

void registerFrames(std::span<const FrameCase> cases, const BenchmarkInputs& inputs) {
  for (const FrameCase& c : cases) {
    auto* registered =
        benchmark::RegisterBenchmark(c.name.c_str(), [&](benchmark::State& s) { measure(s, c, inputs); });
    registered->Unit(benchmark::kMillisecond);
    // With one thread, what the process computed, whichever of its threads did; with more, what the user
    // waits.
    if (c.threads == 1)
      registered->MeasureProcessCPUTime();
    else
      registered->UseRealTime();
  }
}

}  // namespace pomona
