// Measurements that want a process of their own. Each prints one line of JSON.
#pragma once

#include <string>

#include "bench/speed/frames.h"

namespace pomona {

/// Computes one frame and nothing else, for whoever watches the process's memory.
void computeOnce(const FrameCase& frame_case, const BenchmarkInputs& inputs);

/// The distribution of the wall-clock time of `frames` frames, ms.
void measureLatency(const FrameCase& frame_case, const BenchmarkInputs& inputs, int frames);

/// Dense frames of `preset` on 1, 2, 4, 8 and 16 threads, as far as there are processors: the median time
/// (ms) of the frame and of each stage, and the share s of it that is serial by Amdahl's law, T(n) = T(1) (s
/// + (1 - s) / n), fitted by least squares.
void measureScaling(const std::string& preset, const FrameSize& size, const BenchmarkInputs& inputs,
                    int frames);

}  // namespace pomona
