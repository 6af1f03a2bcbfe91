// How many bytes a frame moves per pixel: a model, counted from what the code reads and writes.
#pragma once

#include <string_view>

#include "core/cpu.h"
#include "pomona/options.h"

namespace pomona {

/// Bytes per pixel. A byte written and read again counts twice; what stays in registers, tables, the filters
/// after the matching, and the lines that a store fetches first are left out.
struct Traffic {
  double memory = 0;  ///< in buffers as large as the frame: features, sums or checkpoints, maps
  double rows = 0;    ///< in buffers of some rows, which stay in the cache if it holds a few W * D bytes
};

/// The matching of one frame of `height` rows and `pixels` pixels with `options`; zero for mutual
/// information, which matches reduced images as well.
Traffic frameTraffic(const Options& options, int height, double pixels);

/// Of one of the matcher's kernels, rows and frame alike; 0 where the model does not cover it.
double kernelTraffic(std::string_view kernel, const CostOptions& cost, const AggregationOptions& aggregation,
                     int disparities, Isa isa);

}  // namespace pomona
