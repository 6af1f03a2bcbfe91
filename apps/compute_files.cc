#include "apps/compute_files.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <tuple>

#include "apps/muted_stream.h"
#include "apps/rig_options.h"
#include "apps/views.h"
#include "camera/cloud_file.h"
#include "camera/rectify.h"
#include "core/parallel.h"
#include "datasets/colorize.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "datasets/pfm.h"
#include "datasets/png16.h"
#include "datasets/scene_parts.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

struct Frame {
  const ComputePaths& paths;
  const ComputeInputs& inputs;
  const StereoResult& result;
};

// One kind of output: where its path is, which formats it comes in, and how the file's bytes are made.
struct OutputKind {
  const char* option;
  std::string ComputePaths::*path;
  std::vector<std::string> extensions;
  std::string (*encode)(const Frame& frame, const std::string& extension);
};

std::string encodeDisparity(const Frame& frame, const std::string& extension) {
  if (extension == ".pfm") return encodePfm(frame.result.disparity);
  return encodeDisparityPng(frame.result.disparity, frame.paths.opencv_png ? kOpenCvScale : kKittiScale);
}

std::string encodeColor(const Frame& frame, const std::string&) {
  return encodeImage(colorizeDisparity(frame.result.disparity, typicalRange(frame.result.disparity)));
}

std::string encodeState(const Frame& frame, const std::string& extension) {
  if (extension == ".pgm") return encodeImage(frame.result.state, extension);
  return encodeImage(colorizeStates(frame.result.state));
}

std::string encodeConfidence(const Frame& frame, const std::string& extension) {
  if (extension == ".pfm") return encodePfm(frame.result.confidence);
  return encodeImage(confidenceToGray(frame.result.confidence));
}

std::string encodeSigma(const Frame& frame, const std::string&) {
  return encodePfm(frame.result.sigma_px);
}

std::string encodeDepth(const Frame& frame, const std::string& extension) {
  const cv::Mat depth = depthFromDisparity(frame.result.disparity, *frame.inputs.calibration);
  return extension == ".pfm" ? encodePfm(depth) : encodeDepthPng(depth);
}

std::string encodeDepthSigma(const Frame& frame, const std::string&) {
  return encodePfm(depthSigma(frame.result.disparity, frame.result.sigma_px, *frame.inputs.calibration));
}

std::string encodeCloud(const Frame& frame, const std::string& extension) {
  const auto encode = extension == ".pcd" ? encodePcd : encodePly;
  return encode(frame.result.disparity, toBgr8(frame.inputs.left), *frame.inputs.calibration);
}

std::string encodeError(const Frame& frame, const std::string&) {
  return encodeImage(colorizeError(frame.result.disparity, frame.inputs.ground_truth));
}

const std::vector<OutputKind>& outputKinds() {
  static const std::vector<OutputKind> kinds = {
      {"--output", &ComputePaths::disparity, {".pfm", ".png"}, encodeDisparity},
      {"--color", &ComputePaths::color, {".png"}, encodeColor},
      {"--state", &ComputePaths::state, {".png", ".pgm"}, encodeState},
      {"--confidence", &ComputePaths::confidence, {".png", ".pfm"}, encodeConfidence},
      {"--sigma", &ComputePaths::sigma, {".pfm"}, encodeSigma},
      {"--depth", &ComputePaths::depth, {".pfm", ".png"}, encodeDepth},
      {"--depth-sigma", &ComputePaths::depth_sigma, {".pfm"}, encodeDepthSigma},
      {"--cloud", &ComputePaths::cloud, {".ply", ".pcd"}, encodeCloud},
      {"--error", &ComputePaths::error, {".png"}, encodeError},
  };
  return kinds;
}

bool sameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  const auto resolved = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path), error);
  };
  return fs::equivalent(a, b, error) || resolved(a) == resolved(b);
}

void requireExtension(const PlannedOutput& output) {
  const std::vector<std::string>& extensions = output.extensions;
  if (std::find(extensions.begin(), extensions.end(), extensionOf(output.path)) != extensions.end()) return;
  std::string allowed;
  for (const std::string& e : extensions) allowed += (allowed.empty() ? "" : ", ") + e;
  throw std::runtime_error(output.option + " is '" + output.path + "'; allowed extensions: " + allowed);
}

void rectify(const ComputePaths& paths, ComputeInputs& inputs) {
  try {
    Rectifier rectifier(rigNamed(paths.rig));
    rectifier.rectify(inputs.left, inputs.right, availableThreads());
    inputs.left = rectifier.left();
    inputs.right = rectifier.right();
    inputs.mask = rectifier.rectifyMask(inputs.mask, availableThreads());
    inputs.calibration = rectifier.calibration();
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(paths.rig + ": " + e.what());
  }
}

}  // namespace

void checkOutputs(std::span<const PlannedOutput> outputs, std::span<const std::string> inputs) {
  std::vector<std::string> taken;
  for (const PlannedOutput& output : outputs) {
    const std::string& path = output.path;
    requireExtension(output);
    checkOutputPath(path);
    const auto same = [&](const std::string& other) { return !other.empty() && sameFile(path, other); };
    if (std::any_of(inputs.begin(), inputs.end(), same))
      throw std::runtime_error(output.option + " is '" + path + "', which is an input");
    if (std::any_of(taken.begin(), taken.end(), same))
      throw std::runtime_error(output.option + " is '" + path + "', which is another output already");
    taken.push_back(path);
  }
}

void checkOutputs(const ComputePaths& paths) {
  const std::string inputs[] = {paths.left,        paths.right, paths.mask,
                                paths.calibration, paths.rig,   paths.ground_truth};
  std::vector<PlannedOutput> outputs;
  for (const OutputKind& kind : outputKinds())
    if (const std::string& path = paths.*kind.path; !path.empty())
      outputs.push_back({kind.option, path, kind.extensions});
  checkOutputs(outputs, inputs);
  if (paths.opencv_png && extensionOf(paths.disparity) != ".png")
    throw std::runtime_error("--opencv-png: --output is '" + paths.disparity + "'; allowed extension: .png");
}

ComputeInputs readInputs(const ComputePaths& paths) {
  const MutedErrorStream muted;
  ComputeInputs inputs;
  std::tie(inputs.left, inputs.right) = readViews(paths.left, paths.right);
  const cv::Size size = inputs.left.size();
  if (!paths.mask.empty()) inputs.mask = readByteMap(paths.mask, size);
  if (!paths.calibration.empty()) {
    inputs.calibration = rectificationOf(rigNamed(paths.calibration)).calibration;
    requireCalibrationFits(paths.calibration, *inputs.calibration, size);
  }
  if (!paths.rig.empty()) rectify(paths, inputs);
  if (!paths.ground_truth.empty()) inputs.ground_truth = readTruth(paths.ground_truth, inputs.left.size());
  return inputs;
}

std::vector<OutputFile> encodeOutputs(const ComputePaths& paths, const ComputeInputs& inputs,
                                      const StereoResult& result) {
  std::vector<OutputFile> files;
  for (const OutputKind& kind : outputKinds()) {
    const std::string& path = paths.*kind.path;
    if (path.empty()) continue;
    try {
      files.push_back({path, kind.encode({paths, inputs, result}, extensionOf(path))});
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(path + ": " + e.what());
    }
  }
  return files;
}

}  // namespace pomona
