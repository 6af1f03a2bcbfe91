#include "bench/speed/processes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

double millisecondsOf(const auto& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// The smallest value that at least a share `q` of all do not exceed.
double quantile(std::vector<double> values, double q) {
  const auto rank = std::max(1.0, std::ceil(q * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct ThreadTime {
  int threads;
  double milliseconds;
};

/// s of T(n) = a + b / n, where s = a / (a + b): 0 for work that n threads finish n times as fast.
double serialShare(const std::vector<ThreadTime>& times) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const ThreadTime& t : times) {
    const double x = 1.0 / t.threads, y = t.milliseconds;
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double b = (n * sxy - sx * sy) / (n * sxx - sx * sx), a = (sy - b * sx) / n;
  return a / (a + b);
}

using Stage = std::pair<std::string, std::vector<double>>;

/// Times by stage in their order, the whole frame first.
std::vector<Stage> stageTimes(StereoEngine& engine, const ImagePair& pair, int frames) {
  std::vector<Stage> stages = {{"frame", {}}};
  for (int i = 0; i < frames; ++i) {
    const StereoResult* result = nullptr;
    stages[0].second.push_back(millisecondsOf([&] { result = &engine.compute(pair.left, pair.right); }));
    for (const StageTiming& t : result->timings) {
      auto stage =
          std::find_if(stages.begin(), stages.end(), [&](const Stage& s) { return s.first == t.stage; });
      if (stage == stages.end()) stage = stages.insert(stage, {std::string(t.stage), {}});
      stage->second.resize(static_cast<std::size_t>(i) + 1);  // a stage may run twice
      stage->second.back() += t.milliseconds;
    }
  }
  return stages;
}

}  // namespace

void computeOnce(const FrameCase& frame_case, const BenchmarkInputs& inputs) {
  const ImagePair pair = inputs.at(frame_case.size);
  frame_case.prepare(pair)();
}

void measureLatency(const FrameCase& frame_case, const BenchmarkInputs& inputs, int frames) {
  constexpr int kWarmUp = 5;
  const ImagePair pair = inputs.at(frame_case.size);
  const FrameCase::Frame frame = frame_case.prepare(pair);
  for (int i = 0; i < kWarmUp; ++i) frame();
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(millisecondsOf(frame));
  std::printf("{\"name\": \"%s\", \"frames\": %d, \"p50\": %.4f, \"p99\": %.4f, \"max\": %.4f}\n",
              frame_case.name.c_str(), frames, quantile(times, 0.5), quantile(times, 0.99),
              quantile(times, 1));
}

void measureScaling(const std::string& preset, const FrameSize& size, const BenchmarkInputs& inputs,
                    int frames) {
  const ImagePair pair = inputs.at(size);
  std::vector<std::pair<std::string, std::vector<ThreadTime>>> stages;
  for (int threads = 1; threads <= std::min(16, availableThreads()); threads *= 2) {
    Options options = Options::preset(preset);
    options.num_disparities = size.disparities;
    options.threads = threads;
    StereoEngine engine(options);
    engine.compute(pair.left, pair.right);
    const std::vector<Stage> measured = stageTimes(engine, pair, frames);
    stages.resize(measured.size());  // the same ones each time
    for (std::size_t i = 0; i < measured.size(); ++i) {
      stages[i].first = measured[i].first;
      stages[i].second.push_back({threads, quantile(measured[i].second, 0.5)});
    }
  }
  std::printf("{\"preset\": \"%s\", \"size\": \"%s\", \"stages\": [", preset.c_str(), size.name().c_str());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto& [name, times] = stages[i];
    std::printf("%s{\"stage\": \"%s\"", i > 0 ? ", " : "", name.c_str());
    if (times.size() > 1) std::printf(", \"serial_share\": %.4f", serialShare(times));
    std::printf(", \"ms\": {");
    for (std::size_t k = 0; k < times.size(); ++k)
      std::printf("%s\"%d\": %.4f", k > 0 ? ", " : "", times[k].threads, times[k].milliseconds);
    std::printf("}}");
  }
  std::printf("]}\n");
}

}  // namespace pomona
