// What `pomona compute` reads and writes.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "datasets/atomic_file.h"
#include "pomona/calibration.h"
#include "pomona/disparity.h"

namespace pomona {

/// File names as given on the command line; empty where not given.
struct ComputePaths {
  std::string left, right, mask, calibration, rig, ground_truth;
  std::string disparity, color, state, confidence, sigma, depth, depth_sigma, cloud, error;
  bool opencv_png = false;  ///< a .png disparity map counts sixteenths of a pixel, not KITTI's 256ths
};

/// mask, ground_truth and calibration are absent where not given. With a rig, the views and the mask are
/// rectified already.
struct ComputeInputs {
  cv::Mat left, right, mask, ground_truth;
  std::optional<StereoCalibration> calibration;
};

/// An output as the command line names it.
struct PlannedOutput {
  std::string option, path;
  std::vector<std::string> extensions;  ///< allowed ones
};

/// Refuses outputs of a format that cannot be written, in a place that cannot be written, named twice, or
/// naming an input. Throws std::runtime_error; called before any work is done.
void checkOutputs(std::span<const PlannedOutput> outputs, std::span<const std::string> inputs);
void checkOutputs(const ComputePaths& paths);

/// Reads all inputs and checks that they fit together. Throws std::runtime_error naming the file.
ComputeInputs readInputs(const ComputePaths& paths);

/// The bytes of every output asked for.
std::vector<OutputFile> encodeOutputs(const ComputePaths& paths, const ComputeInputs& inputs,
                                      const StereoResult& result);

}  // namespace pomona
