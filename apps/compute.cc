#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/compute_files.h"
#include "apps/print.h"
#include "apps/search_range.h"
#include "apps/verbs.h"
#include "pomona/engine.h"
#include "pomona/evaluation.h"

namespace pomona {
namespace {

struct ComputeArguments {
  ComputePaths paths;
  std::optional<int> max_disparity;
  int min_disparity = 0;
  bool adaptive_range = false;
  std::string preset = "balanced";
  std::string mode = "dense";
  float min_confidence = 0;
  std::string memory = "automatic";
  int threads = 0;
  std::string isa;
  bool timings = false;
};

MemoryMode memoryMode(const std::string& name) {
  return name == "low" ? MemoryMode::kLow : name == "speed" ? MemoryMode::kSpeed : MemoryMode::kAutomatic;
}

void printSummary(const ComputeArguments& arguments, const SearchRange& range, const StereoResult& result,
                  double milliseconds) {
  std::size_t known = 0;
  std::array<std::size_t, 256> pixels_in_state{};
  float low = 0, high = 0;
  for (int y = 0; y < result.disparity.rows; ++y)
    for (int x = 0; x < result.disparity.cols; ++x) {
      ++pixels_in_state[result.state.at<std::uint8_t>(y, x)];
      const float d = result.disparity.at<float>(y, x);
      if (std::isnan(d)) continue;
      low = known == 0 ? d : std::min(low, d);
      high = known == 0 ? d : std::max(high, d);
      ++known;
    }
  const double percent = 100.0 / static_cast<double>(result.disparity.total());
  print("size      %d x %d", result.disparity.cols, result.disparity.rows);
  print("searched  %d to %d px (%s)", range.min, range.min + range.count - 1, range.source.c_str());
  const auto noMinusZero = [](float d) { return std::abs(d) < 0.005f ? 0.0f : d; };
  if (known > 0) print("found     %.2f to %.2f px", noMinusZero(low), noMinusZero(high));
  constexpr float kMotion_px = 0.5f;
  if (known > 0 && -low < kMotion_px && high < kMotion_px)
    print("warning   nothing moves between the views: are they the same picture?");
  print("coverage  %.2f %% (%s)", percent * known, arguments.mode.c_str());
  for (std::size_t state = 0; state < pixels_in_state.size(); ++state)
    if (pixels_in_state[state] > 0)
      print("  %-28s %6.2f %%", std::string(name(static_cast<PixelState>(state))).c_str(),
            percent * pixels_in_state[state]);
  // Of 24 real pairs, `fast` measures 38 % and more, `balanced` 52; of these exchanged, `balanced` 4 to 23,
  // but for one, 37.
  constexpr double kFew_percent = 33;
  const std::size_t measured = pixels_in_state[static_cast<std::size_t>(PixelState::kMeasured)];
  if (arguments.preset != "paper" && percent * measured < kFew_percent)  // "paper" measures none at this size
    print("warning   few pixels could be measured; pomona check may tell why");
  if (!std::isnan(result.row_offset_px))
    print("rows      right view %+.2f px, %.2f px where it is worst%s%s", result.row_offset_px,
          result.row_error_px, result.rows_aligned ? "; matched after moving it" : "",
          !result.rowsAreOff()  ? ""
          : result.rows_aligned ? "; warning: the cameras want a new calibration"
                                : "; warning: the views are not aligned; see pomona check");
  print("time      %.1f ms (%s)", milliseconds, arguments.preset.c_str());
  if (arguments.timings)
    for (const StageTiming& timing : result.timings)
      print("  %-28s %8.2f ms", std::string(timing.stage).c_str(), timing.milliseconds);
}

void printErrors(const DisparityErrors& errors) {
  constexpr std::size_t kOnePixel = 1, kTwoPixels = 2;  // in kBadThresholds_px
  print(
      "ground truth: %lld known pixels, bad-1 %.2f %%, bad-2 %.2f %%, average error %.3f px, coverage %.2f "
      "%%",
      static_cast<long long>(errors.known), errors.badPercent(kOnePixel), errors.badPercent(kTwoPixels),
      errors.averageErrorPx(), errors.coveragePercent());
}

void compute(const ComputeArguments& arguments) {
  if (arguments.min_confidence != 0 && arguments.mode != "sparse")
    throw std::invalid_argument("--min-confidence: --mode is '" + arguments.mode +
                                "'; allowed: sparse (a dense map keeps all pixels)");
  const ComputePaths& paths = arguments.paths;
  for (const auto& [option, path] :
       {std::pair{"--depth", &paths.depth}, {"--depth-sigma", &paths.depth_sigma}, {"--cloud", &paths.cloud}})
    if (!path->empty() && paths.calibration.empty() && paths.rig.empty())
      throw CLI::RequiresError(option, "--calib or --rig");
  checkOutputs(arguments.paths);
  const ComputeInputs inputs = readInputs(arguments.paths);
  Options options = Options::preset(arguments.preset);
  options.threads = arguments.threads;
  options.isa = arguments.isa;
  const SearchRange range =
      searchRange(paths, inputs, arguments.min_disparity, arguments.max_disparity, options);
  options.min_disparity = range.min;
  options.num_disparities = range.count;
  options.adaptive_range = arguments.adaptive_range;
  options.mode = arguments.mode == "sparse" ? OutputMode::kSparse : OutputMode::kDense;
  options.validation.min_confidence = arguments.min_confidence;
  options.memory = memoryMode(arguments.memory);

  StereoEngine engine(options);
  const auto start = std::chrono::steady_clock::now();
  const StereoResult& result = engine.compute(inputs.left, inputs.right, inputs.mask);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;

  writeFiles(encodeOutputs(arguments.paths, inputs, result));
  printSummary(arguments, range, result, elapsed.count());
  if (!inputs.ground_truth.empty()) printErrors(compareWithTruth(result.disparity, inputs.ground_truth));
}

void addFileOptions(CLI::App& verb, ComputePaths& paths) {
  verb.add_option("left", paths.left, "Left image, the reference: 8 or 16 bits, gray or colour")->required();
  verb.add_option("right", paths.right, "Right image; the pair is rectified unless --rig says how to")
      ->required();
  verb.add_option("-o,--output", paths.disparity,
                  "Disparity map: .pfm (float pixels), or .png (16 bits, KITTI's 1/256 px, 0 unknown)")
      ->required();
  verb.add_flag("--opencv-png", paths.opencv_png, "Let the .png disparity map count 1/16 px, 0 unknown");
  CLI::Option* calibration = verb.add_option("--calib", paths.calibration,
                                             "Geometry of the rectified pair, and the range if it has ndisp: "
                                             "Middlebury's calib.txt, or any file that "
                                             "pomona rig shows");
  verb.add_option("--rig", paths.rig, "The views are not rectified: rectify them first, by this rig")
      ->excludes(calibration);
  verb.add_option("--mask", paths.mask, "8-bit gray image; pixels that are 0 stay unknown");
  CLI::Option* ground_truth =
      verb.add_option("--gt", paths.ground_truth, "True disparities (.pfm, or KITTI .png): print the error");
  verb.add_option("--color", paths.color, "Picture of the disparities (.png): warm is near, black unknown");
  verb.add_option("--state", paths.state, "Each pixel's state: a picture (.png), or its number (.pgm)");
  verb.add_option("--confidence", paths.confidence, "Confidence: gray picture (.png), or 0 to 1 (.pfm)");
  verb.add_option("--sigma", paths.sigma,
                  "Standard deviation of the disparities (.pfm, pixels, inf unknown)");
  verb.add_option("--depth", paths.depth,
                  "Depth: metres (.pfm, inf unknown), or millimetres (16-bit .png, 0 unknown)");
  verb.add_option("--depth-sigma", paths.depth_sigma,
                  "Standard deviation of the depth (.pfm, metres, inf unknown)");
  verb.add_option("--cloud", paths.cloud,
                  "Coloured point cloud in metres: .ply, or organised as the image is: .pcd");
  verb.add_option("--error", paths.error,
                  "Picture of the error (.png): green 0, red 4 px and more, white no disparity")
      ->needs(ground_truth);
}

void addMatchingOptions(CLI::App& verb, ComputeArguments& arguments) {
  verb.add_option("--min-disparity", arguments.min_disparity,
                  "Smallest disparity searched (default 0; may be negative)");
  verb.add_option(
      "--max-disparity", arguments.max_disparity,
      "Search [min, max): max itself is not searched (default: the calibration's ndisp, else estimated)");
  verb.add_flag("--adaptive-range", arguments.adaptive_range,
                "Search each band of rows only for what a look at a quarter of the size finds in it: faster "
                "where the range is wider than the scene by 64 or more");
  verb.add_option("--preset", arguments.preset, "fast, balanced (default), quality or paper");
  verb.add_option("--mode", arguments.mode, "dense (default) or sparse: measured pixels only")
      ->check(CLI::IsMember({"dense", "sparse"}));
  verb.add_option("--min-confidence", arguments.min_confidence,
                  "With --mode sparse: leave out what is less likely right than this, 0 (default) to 1");
  verb.add_option("--memory", arguments.memory,
                  "speed, low (a little slower) or automatic (default): the same map in all")
      ->check(CLI::IsMember({"automatic", "speed", "low"}));
  verb.add_option("--threads", arguments.threads, "Worker threads (default 0: one per processor)");
  verb.add_option("--isa", arguments.isa, "Instruction set to use (see pomona info)");
  verb.add_flag("--timings", arguments.timings, "Print the time of every stage");
}

}  // namespace

void addCompute(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("compute", "Compute the disparity map of a rectified pair");
  const auto arguments = std::make_shared<ComputeArguments>();  // lives as long as the callback
  addFileOptions(*verb, arguments->paths);
  addMatchingOptions(*verb, *arguments);
  verb->callback([arguments] { compute(*arguments); });
}

}  // namespace pomona
