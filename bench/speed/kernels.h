// Every kernel of every instruction set.
#pragma once

#include <string>
#include <vector>

#include "bench/speed/inputs.h"

namespace pomona {

/// One benchmark per stage and instruction set: the stage runs over a whole frame on one thread, and the time
/// spent in each of its kernels is counted as "kernel:NAME" (ns per pixel of what the stage works on), beside
/// "bytes:NAME" (per pixel) where the model in traffic.h covers the kernel. Returns their names.
std::vector<std::string> registerKernels(const FrameSize& size, const BenchmarkInputs& inputs);

}  // namespace pomona
