// Whole frames: Pomona's presets, and OpenCV's matchers beside them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/speed/inputs.h"
#include "bench/speed/traffic.h"

namespace pomona {

/// One method at one size.
struct FrameCase {
  using Frame = std::function<void()>;  ///< computes one frame

  std::string name;  ///< "frame/fast/dense/1280x720/D64/t1"
  FrameSize size;
  int threads;
  Traffic traffic;    ///< zero where no model is stated
  bool keeps_memory;  ///< from frame to frame, so that only the first ones pay for it
  /// Sets the method up, and OpenCV's number of threads. The images must outlive the result.
  std::function<Frame(const ImagePair&)> prepare;
};

/// The presets sparse and dense, and OpenCV's matchers with their own checks and raw (nothing checked or
/// removed), with 1 and 2 threads; `paper` at a height of 720 only, "fast-avx2" where the CPU has more than
/// that, "fast-low" with MemoryMode::kLow, "fast-8paths" with as many paths as OpenCV's MODE_HH.
std::vector<FrameCase> frameCases(std::span<const FrameSize> sizes);

/// Throws std::invalid_argument if there is none of that name.
const FrameCase& findCase(std::span<const FrameCase> cases, const std::string& name);

void registerFrames(std::span<const FrameCase> cases, const BenchmarkInputs& inputs);

}  // namespace pomona
