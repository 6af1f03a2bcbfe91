#include "bench/speed/traffic.h"

#include <cmath>

#include "sgm/aggregation.h"
#include "sgm/kernels.h"

namespace pomona {
namespace {

/// What one match depends on, per pixel.
struct MatchBytes {
  double lanes;   // disparities, padded to whole vectors
  double sum;     // of a partial sum
  double planes;  // features of one view that the cost compares
  double paths;   // carried from row to row
  bool supported;

  MatchBytes(const CostOptions& cost, const AggregationOptions& aggregation, int disparities, Isa isa)
      : sum(needsWideSums(maximumCost(cost.cost), aggregation) ? 2 : 1),
        planes(planesOf(cost.cost)),
        paths(aggregation.paths == 8 ? 3 : 1),
        supported(cost.support_color_step > 0) {
    const int bytes = sgmKernels(isa).vector_bytes;
    lanes = vectorsFor(disparities, bytes) * bytes;
  }
  static double planesOf(MatchingCost cost) {
    if (cost == MatchingCost::kBlended) return kBlendedPlanes;
    return cost == MatchingCost::kMutualInformation ? 1 : (maximumCost(cost) + 7) / 8;
  }

  double costKernel() const { return 2 * planes + lanes; }
  double supportKernel() const { return 4 * lanes + 1; }
  double pathState() const { return 2 * paths * lanes + 2 * 16; }  // read and written; minima: 4 quads
  double firstKernel() const { return lanes + pathState() + sum * lanes; }
  double winners() const { return 9 * 2; }
  double lastKernel() const { return firstKernel() + 2 * lanes + winners(); }  // 2: recent 16-bit sums
};

Traffic matchTraffic(const MatchBytes& m, MemoryMode memory, int height, double pixels) {
  constexpr double kSides = 2, kDirections = 4, kGuide = 3;  // a colour image
  const double sums = 2 * m.sum * m.lanes;                   // written and read
  const bool low = chooseMemory(memory, m.sum * m.lanes * pixels) == MemoryMode::kLow;
  const double passes = low ? 3 : 2;
  const double rows_per_checkpoint = 0.5 * std::sqrt(height * m.paths / m.sum);  // on average
  const double checkpoints = 2 * m.paths * m.lanes / rows_per_checkpoint;

  const double features = kSides * m.planes             // written
                          + 2 * m.planes                // the right ones laid out anew
                          + passes * kSides * m.planes  // read by the cost kernel
                          + passes * kGuide;            // for the colour steps
  const double maps = 4 + 4 + 4 + 1;                    // disparities, margin, state
  const double costs = 2 * m.lanes + (m.supported ? m.supportKernel() : 0);
  Traffic t;
  t.memory = features + maps + (low ? checkpoints : sums);
  t.rows = passes * (costs + m.pathState() + 2 * kDirections) + 2 * m.lanes + 2 * m.winners();
  if (low) t.rows += sums + m.sum * m.lanes;  // those of the first pass are written for nobody
  return t;
}

}  // namespace

Traffic frameTraffic(const Options& o, int height, double pixels) {
  if (o.cost.cost == MatchingCost::kMutualInformation) return {};
  const auto ofMatch = [&](const CostOptions& cost, const AggregationOptions& aggregation) {
    return matchTraffic({cost, aggregation, o.num_disparities, chooseIsa(o.isa)}, o.memory, height, pixels);
  };
  Traffic t = ofMatch(o.cost, o.aggregation);
  if (o.second_pass.enabled && o.mode == OutputMode::kDense) {
    const Traffic second = ofMatch(o.second_pass.cost, o.second_pass.aggregation);
    t.memory += second.memory;
    t.rows += second.rows;
  }
  return t;
}

double kernelTraffic(std::string_view kernel, const CostOptions& cost, const AggregationOptions& aggregation,
                     int disparities, Isa isa) {
  const MatchBytes m(cost, aggregation, disparities, isa);
  if (kernel == "censusCost" || kernel == "blendedCost" || kernel == "tableCost") return m.costKernel();
  if (kernel == "support") return m.supportKernel();
  if (kernel == "aggregateFirst") return m.firstKernel();
  if (kernel == "aggregateLast") return m.lastKernel();
  return 0;
}

}  // namespace pomona
