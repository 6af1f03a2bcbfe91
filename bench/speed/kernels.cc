#include "bench/speed/kernels.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>

#include "bench/speed/kernel_clock.h"
#include "bench/speed/kernel_drivers.h"
#include "bench/speed/traffic.h"
#include "core/cpu.h"

namespace pomona {
namespace {

/// The tables of one instruction set, every kernel timed.
KernelTables timedTables(Isa isa) {
  KernelTables t{sgmKernels(isa), filterKernels(isa), pyramidKernels(isa), cameraKernels(isa)};
#define TIMED(table, kernel) t.table.kernel = timed<#kernel>(t.table.kernel)
  TIMED(sgm, gray8), TIMED(sgm, gray16), TIMED(sgm, score);
  TIMED(sgm, census8), TIMED(sgm, census16), TIMED(sgm, sobel), TIMED(sgm, colorSteps);
  TIMED(sgm, dealRow), TIMED(sgm, censusCost), TIMED(sgm, tableCost), TIMED(sgm, blendedCost),
      TIMED(sgm, support);
  TIMED(sgm, prior), TIMED(sgm, aggregateFirst), TIMED(sgm, aggregateLast);
  TIMED(sgm, refine[0]), TIMED(sgm, refine[1]), TIMED(sgm, refine[2]), TIMED(sgm, refine[3]);
  TIMED(filters, leftRight), TIMED(filters, trustCodes), TIMED(filters, trustPairs);
  TIMED(filters, findRuns), TIMED(filters, uniteRuns);
  TIMED(filters, median3x3), TIMED(filters, median5x5), TIMED(filters, jointBilateral);
  TIMED(filters, nearJumps), TIMED(filters, weightedMedian);
  TIMED(filters, refinePlanes[0]), TIMED(filters, refinePlanes[1]);
  TIMED(pyramid, accumulate8), TIMED(pyramid, accumulate16);
  TIMED(pyramid, cubicRow), TIMED(pyramid, cubicColumn);
  TIMED(pyramid, reduceRow), TIMED(pyramid, reduceColumn);
  TIMED(pyramid, expandRow), TIMED(pyramid, addExpandedColumn);
  TIMED(pyramid, average), TIMED(pyramid, findHoles), TIMED(pyramid, advanceRays);
  TIMED(pyramid, difference1), TIMED(pyramid, largestDifference3);
  TIMED(pyramid, countSourcesAndHoles), TIMED(pyramid, countNearPlane), TIMED(pyramid, planeDisparities);
  TIMED(pyramid, localResidual), TIMED(pyramid, correlate);
  TIMED(pyramid, gatherCandidates), TIMED(pyramid, candidateMedian);
  TIMED(camera, interpolate8), TIMED(camera, interpolate16);
  TIMED(camera, reduceBlocks), TIMED(camera, contrast);
#undef TIMED
  return t;
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

void measure(benchmark::State& state, const KernelDriver& driver, Isa isa, KernelMaterial& material) {
  const KernelTables tables = timedTables(isa);
  const double clock_ns = clockNanoseconds();
  for (int i = 0; i < kWarmUpFrames; ++i) driver.run(material, tables);
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
  const auto material = std::make_shared<std::unique_ptr<KernelMaterial>>();  // made by the first that is run
  std::vector<std::string> names;
  for (const KernelDriver& driver : kernelDrivers())
    for (Isa isa : usableIsas()) {
      names.push_back("kernel/" + std::string(driver.name) + "/" + std::string(name(isa)) + "/" +
                      size.name());
      benchmark::RegisterBenchmark(names.back().c_str(),
                                   [=, &inputs](benchmark::State& state) {
                                     if (!*material)
                                       *material = std::make_unique<KernelMaterial>(size, inputs);
                                     measure(state, driver, isa, **material);
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    }
  return names;
}

}  // namespace pomona
