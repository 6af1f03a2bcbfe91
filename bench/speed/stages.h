// The stages of a frame, each timed where it runs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/speed/inputs.h"

namespace pomona {

/// One benchmark per preset and number of threads, with a counter "stage:NAME" (ms, wall clock) per stage of
/// the dense frame; and one for the parts of the matching and for the coarse maps, which few frames need.
/// Returns their names.
std::vector<std::string> registerStages(const FrameSize& size, const BenchmarkInputs& inputs);

}  // namespace pomona
