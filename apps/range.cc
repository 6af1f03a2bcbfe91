// `pomona range`: sparse points and objects, by a plugin.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/compute_files.h"
#include "apps/print.h"
#include "apps/search_range.h"
#include "apps/sparse_files.h"
#include "apps/verbs.h"
#include "apps/views.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "plugins/common/drawing.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

struct RangeArguments {
  ComputePaths paths;
  std::string plugin, drawing, pictures;
  std::vector<std::string> settings, outputs;
  std::string preset = "balanced";
  int min_disparity = 0;
  std::optional<int> max_disparity;
  int threads = 0;
};

std::string picturePath(const RangeArguments& arguments, const std::string& name) {
  return arguments.pictures + "-" + name + ".png";
}

/// Called before any work is done, and again when it is known which pictures there are.
void checkRangeOutputs(const RangeArguments& arguments, const std::vector<SparsePicture>& pictures) {
  const ComputePaths& paths = arguments.paths;
  const std::string inputs[] = {paths.left, paths.right, paths.mask, paths.calibration, paths.rig};
  std::vector<PlannedOutput> outputs;
  for (const std::string& path : arguments.outputs)
    outputs.push_back({"--output", path, {".csv", ".ply", ".json"}});
  if (!arguments.drawing.empty()) outputs.push_back({"--draw", arguments.drawing, {".png"}});
  if (!arguments.pictures.empty())
    for (const SparsePicture& picture : pictures)
      outputs.push_back({"--pictures", picturePath(arguments, picture.name), {".png"}});
  checkOutputs(outputs, inputs);
}

LoadedPlugin& chosenPlugin(PluginHost& host, const std::string& name) {
  try {
    return host.plugin(name);
  } catch (const std::invalid_argument& e) {
    const std::size_t refused = host.refused().size();
    const std::string more = "; " + std::to_string(refused) + " could not be loaded (see pomona plugins)";
    throw std::invalid_argument(std::string("--") + e.what() + (refused > 0 ? more : ""));
  }
}

std::vector<OutputFile> encodeOutputs(const RangeArguments& arguments, const SparseResult& result,
                                      const cv::Mat& left, const PluginSettings& settings) {
  std::vector<OutputFile> files;
  for (const std::string& path : arguments.outputs) {
    const std::string extension = extensionOf(path);
    files.push_back({path, extension == ".csv"   ? encodeCsv(result)
                           : extension == ".ply" ? encodePly(result, left)
                                                 : encodeJson(result, arguments.plugin, settings)});
  }
  if (!arguments.drawing.empty()) files.push_back({arguments.drawing, encodeImage(drawSparse(left, result))});
  if (!arguments.pictures.empty())
    for (const SparsePicture& picture : result.pictures)
      files.push_back({picturePath(arguments, picture.name), encodeImage(picture.image)});
  return files;
}

std::string withSigma(double value, double sigma) {
  std::ostringstream text;
  text.precision(5);
  text << value;
  text.precision(2);
  if (std::isfinite(sigma)) text << " +- " << sigma;
  return text.str();
}

void printObject(const SparseObject& object) {
  const std::string label = printable(object.label);
  if (!object.found())
    return print("object    %s: not found: %s", label.c_str(), printable(object.why_not).c_str());
  std::string line = "object    " + label + ": ";
  if (std::isfinite(object.distance_m))
    line += withSigma(object.distance_m, object.sigma_m) + " m";
  else
    line += "found, but not ranged";
  if (std::isfinite(object.bearing_deg)) line += ", " + withSigma(object.bearing_deg, NAN) + " deg right";
  print("%s, support %d", line.c_str(), object.support);
}

void printSummary(const std::string& plugin, const SparseResult& result, double milliseconds) {
  float near_m = INFINITY, far_m = 0;
  int placed = 0;
  for (const SparsePoint& point : result.points) {
    if (!std::isfinite(point.point_m.z)) continue;
    near_m = std::min(near_m, point.point_m.z);
    far_m = std::max(far_m, point.point_m.z);
    ++placed;
  }
  if (result.points.empty())
    print("points    none found");
  else if (placed == 0)
    print("points    %zu, none in front of the cameras", result.points.size());
  else
    print("points    %zu, Z from %.3f to %.3f m", result.points.size(), near_m, far_m);
  for (const SparseObject& object : result.objects) printObject(object);
  for (const SparseFigure& figure : result.figures)
    print("%-28s  %.6g%s%s", printable(figure.name).c_str(), figure.value, figure.unit.empty() ? "" : " ",
          printable(figure.unit).c_str());
  print("time      %.1f ms (%s)", milliseconds, plugin.c_str());
}

void range(const RangeArguments& arguments) {
  if (arguments.paths.calibration.empty() && arguments.paths.rig.empty())
    throw CLI::RequiresError("range", "--calib or --rig");
  checkRangeOutputs(arguments, {{"any", {}}});
  PluginHost host;
  LoadedPlugin& plugin = chosenPlugin(host, arguments.plugin);
  PluginSettings settings = plugin.settings();
  settings.assign(arguments.settings);
  const ComputeInputs inputs = readInputs(arguments.paths);
  cv::Mat left = inputs.left, right = inputs.right;
  toBytes(left, right);

  PluginRunOptions options{inputs.mask, {}, arguments.threads};
  options.dense = [&] {
    Options engine = Options::preset(arguments.preset);
    engine.threads = arguments.threads;
    const SearchRange searched =
        searchRange(arguments.paths, inputs, arguments.min_disparity, arguments.max_disparity, engine);
    engine.min_disparity = searched.min;
    engine.num_disparities = searched.count;
    return computeDisparity(inputs.left, inputs.right, engine, inputs.mask);
  };
  const auto start = std::chrono::steady_clock::now();
  const SparseResult result = plugin.run(left, right, *inputs.calibration, settings, options);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  checkRangeOutputs(arguments, result.pictures);
  writeFiles(encodeOutputs(arguments, result, left, settings));
  printSummary(arguments.plugin, result, elapsed.count());
}

}  // namespace

void addRange(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("range", "Range sparse points and objects by a plugin");
  const auto arguments = std::make_shared<RangeArguments>();  // lives as long as the callback
  ComputePaths& paths = arguments->paths;
  verb->add_option("left", paths.left, "Left image")->required();
  verb->add_option("right", paths.right, "Right image")->required();
  CLI::Option* calibration =
      verb->add_option("--calib", paths.calibration, "Geometry of the rectified pair (see pomona rig)");
  verb->add_option("--rig", paths.rig, "The views are not rectified: rectify them first, by this rig")
      ->excludes(calibration);
  verb->add_option("--plugin", arguments->plugin, "Which one (see pomona plugins)")->required();
  verb->add_option("--set", arguments->settings, "PARAMETER=VALUE of the plugin; may be given often")
      ->allow_extra_args(false);
  verb->add_option("-o,--output", arguments->outputs,
                   "Points (.csv), coloured point cloud (.ply), or everything (.json); may be given often")
      ->allow_extra_args(false);
  verb->add_option("--draw", arguments->drawing, "Picture of points and objects in the left view (.png)");
  verb->add_option("--pictures", arguments->pictures, "Write the plugin's own pictures as THIS-name.png");
  verb->add_option("--mask", paths.mask, "8-bit gray image; pixels that are 0 are not used");
  verb->add_option("--preset", arguments->preset, "Of the dense map, where the plugin asks for it");
  verb->add_option("--min-disparity", arguments->min_disparity, "Of the dense map: smallest one searched");
  verb->add_option("--max-disparity", arguments->max_disparity,
                   "Of the dense map: search below this (default: the calibration's ndisp, else estimated)");
  verb->add_option("--threads", arguments->threads, "Worker threads (default 0: one per processor)");
  verb->callback([arguments] { range(*arguments); });
}

}  // namespace pomona
