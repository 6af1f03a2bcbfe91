// Switches the stages of dense maps off, one at a time, and tabulates what each gains and costs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

#include "bench/accuracy/measure.h"
#include "bench/accuracy/table.h"
#include "bench/ladder/rungs.h"
#include "datasets/atomic_file.h"
#include "pomona/engine.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

constexpr const char* kIntroduction = R"(# The ladder

Written by `pomona_ladder`: the scenes of [accuracy.md](accuracy.md), dense maps, one stage at a time switched off by its
option, all others left on. *Gain*: by how much bad-1 and bad-2 rise without the stage, in points, means over the scenes;
A: all pixels, N: those that both cameras see. *Cost*: by how much the frame takes longer with it than with what stands
in its place, in ms and in percent of the whole; CPU time of one thread, the least of several runs of each scene, mean
over the scenes. A stage that takes pixels away or puts better ones in may save more time in those after it than it
takes: its cost is then negative. So are costs of next to nothing, by chance.

The visibility test and the match of whole segments have no option: they are part of segment planes, and the former of
rays, too.
)";

struct RungResult {
  std::vector<SceneFigures> scenes;
  std::vector<double> cpu_ms;  // per scene

  double meanMs() const { return weightedMean(cpu_ms); }
};

double cpuMs() {
  constexpr double kMsPerS = 1000;
  return kMsPerS * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Options optionsOf(const Rung& rung, int num_disparities) {
  Options options = Options::preset(rung.preset);
  options.num_disparities = num_disparities;
  options.threads = 1;
  rung.take_away(options);
  return options;
}

/// The least of as many rounds as are asked for, two frames in each. The rungs take turns, so that a busy
/// spell of the machine does not hit one alone.
void measureScene(const std::string& name, const Scene& scene, int num_disparities, int rounds,
                  std::vector<RungResult>& results) {
  constexpr int kFramesPerRound = 2;
  for (RungResult& result : results) result.cpu_ms.push_back(std::numeric_limits<double>::infinity());
  for (int frame = 0; frame < rounds * kFramesPerRound; frame += kFramesPerRound)
    for (std::size_t i = 0; i < results.size(); ++i) {
      StereoEngine engine(optionsOf(rungs()[i], num_disparities));
      for (int k = 0; k < kFramesPerRound; ++k) {
        const double begin_ms = cpuMs();
        const StereoResult& map = engine.compute(scene.left, scene.right);
        results[i].cpu_ms.back() = std::min(results[i].cpu_ms.back(), cpuMs() - begin_ms);
        if (frame + k == 0)
          results[i].scenes.push_back(sceneFigures(name, scene, {map.disparity, map.state, map.confidence}));
      }
    }
}

std::string fixed(double value, int decimals) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

std::string markdownOf(const std::vector<RungResult>& results) {
  std::ostringstream out;
  out << kIntroduction;
  const RungResult* whole = nullptr;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Rung& rung = rungs()[i];
    if (*rung.instead == '\0') {
      whole = &results[i];
      const SceneFigures mean = MethodFigures{"", MapKind::kDense, whole->scenes}.mean();
      out << "\n## `" << rung.preset << "`: bad-1 A " << fixed(mean.all[kBad1], 2) << ", N "
          << fixed(mean.nonoccluded[kBad1], 2) << ", " << fixed(whole->meanMs(), 0) << " ms\n\n";
      addHeader(out,
                {"stage", "without it", "gain A bad-1", "N bad-1", "A bad-2", "cost ms", "% of the whole"});
      continue;
    }
    const SceneFigures with = MethodFigures{"", MapKind::kDense, whole->scenes}.mean();
    const SceneFigures without = MethodFigures{"", MapKind::kDense, results[i].scenes}.mean();
    const double cost_ms = whole->meanMs() - results[i].meanMs();
    addRow(out, {rung.stage, rung.instead, fixed(without.all[kBad1] - with.all[kBad1], 2),
                 fixed(without.nonoccluded[kBad1] - with.nonoccluded[kBad1], 2),
                 fixed(without.all[kBad2] - with.all[kBad2], 2), fixed(cost_ms, 1),
                 fixed(100 * cost_ms / whole->meanMs(), 0)});
  }
  return out.str();
}

int run(const std::string& folder, const std::string& path, int rounds) {
  if (!path.empty()) checkOutputPath(path);
  Failures failures("pomona_ladder");
  std::vector<RungResult> results(rungs().size());
  forEachScene(folder, failures, [&](const std::string& name, const Scene& scene, int num_disparities) {
    measureScene(name, scene, num_disparities, rounds, results);
  });
  const std::string tables = markdownOf(results);
  std::cout << tables;
  if (!path.empty()) writeFile(path, tables);
  return failures.count() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  std::string folder, path;
  int rounds = 3;
  CLI::App app("What each stage of a dense map gains and costs, on scenes in Middlebury's layout");
  app.add_option("scenes", folder, "folder below which the scenes lie")->required();
  app.add_option("--markdown", path, "write the tables to this file");
  app.add_option("--rounds", rounds, "runs of each scene, two frames in each")->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(folder, path, rounds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_ladder: error: %s\n", error.what());
    return 1;
  }
}
