// Speed of kernels, stages and frames. scripts/bench runs it, and makes tables of what it prints.
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/speed/frames.h"
#include "bench/speed/kernels.h"
#include "bench/speed/processes.h"
#include "bench/speed/stages.h"
#include "core/cpu.h"

namespace pomona {
namespace {

struct Arguments {
  std::string pair = "out/samples/Motorcycle";
  std::vector<std::string> sizes = {"640x480/D64",   "640x480/D128",   "1280x720/D64",
                                    "1280x720/D128", "1920x1080/D128", "2880x1984/D256"};
  std::string detail_size = "1280x720/D128";
  bool list = false;
  std::string once, latency, scaling;
  int frames = 100;
};

FrameSize parseSize(const std::string& text) {
  FrameSize size{};
  if (std::sscanf(text.c_str(), "%dx%d/D%d", &size.width, &size.height, &size.disparities) != 3 ||
      size.name() != text || std::min({size.width, size.height, size.disparities}) < 1)
    throw std::invalid_argument("\"" + text + "\" is no size; an example of one: 1280x720/D128");
  return size;
}

void run(const Arguments& arguments) {
  std::vector<FrameSize> sizes;
  for (const std::string& size : arguments.sizes) sizes.push_back(parseSize(size));
  const FrameSize detail_size = parseSize(arguments.detail_size);
  const BenchmarkInputs inputs(arguments.pair);
  const std::vector<FrameCase> cases = frameCases(sizes);
  if (!arguments.once.empty()) {
    if (arguments.once == "nothing")
      inputs.at(sizes.front());
    else
      computeOnce(findCase(cases, arguments.once), inputs);
    return;
  }
  if (!arguments.latency.empty())
    return measureLatency(findCase(cases, arguments.latency), inputs, arguments.frames);
  if (!arguments.scaling.empty())
    return measureScaling(arguments.scaling, detail_size, inputs, arguments.frames);

  registerFrames(cases, inputs);
  std::vector<std::string> names = registerStages(detail_size, inputs);
  for (std::string& name : registerKernels(detail_size, inputs)) names.push_back(std::move(name));
  if (arguments.list) {
    for (const FrameCase& c : cases) std::puts(c.name.c_str());
    for (const std::string& name : names) std::puts(name.c_str());
    return;
  }
  benchmark::AddCustomContext("input", inputs.description());
  benchmark::AddCustomContext("isa", std::string(name(chooseIsa(""))));
  benchmark::AddCustomContext("cpu", std::string(cpuModel()));
  benchmark::AddCustomContext("opencv", CV_VERSION);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  benchmark::Initialize(&argc, argv);  // takes its own options away
  CLI::App app("Speed of kernels, stages and frames; Google Benchmark's options work, too");
  app.add_option("--pair", arguments.pair, "scene in Middlebury's layout");
  app.add_option("--sizes", arguments.sizes, "of the frames, e.g. 1280x720/D128")->delimiter(',');
  app.add_option("--detail-size", arguments.detail_size, "of the frame that stages and kernels are timed in");
  app.add_flag("--list", arguments.list, "only name the benchmarks");
  app.add_option("--once", arguments.once, "compute this frame once, or \"nothing\" but the input");
  app.add_option("--latency", arguments.latency, "the distribution of this frame's times");
  app.add_option("--scaling", arguments.scaling, "a preset's time by number of threads");
  app.add_option("--frames", arguments.frames, "of --latency and --scaling")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    pomona::run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_bench: error: %s\n", error.what());
    return 1;
  }
}
