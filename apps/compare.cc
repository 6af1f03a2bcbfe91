#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/contact_sheet.h"
#include "apps/figure_columns.h"
#include "apps/measure.h"
#include "apps/method_list.h"
#include "apps/muted_stream.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "apps/views.h"
#include "datasets/atomic_file.h"
#include "datasets/colorize.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "datasets/walk.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

constexpr int kSeveralScenesWidth_px = 400, kOneSceneWidth_px = 560;
constexpr std::size_t kBad2 = 2;  // of kBadThresholds_px

struct CompareArguments {
  std::vector<std::string> inputs;
  MethodArguments methods;
  std::string sheet;
};

// Two image files are a pair; anything else is a list of folders.
std::vector<SceneFiles> scenesOf(const CompareArguments& arguments) {
  const auto& inputs = arguments.inputs;
  const bool pair = inputs.size() == 2 && !fs::is_directory(inputs[0]) && !fs::is_directory(inputs[1]);
  if (!pair) return findScenes(inputs);
  SceneFiles files;
  files.layout = SceneLayout::kManifest;
  files.name = fs::path(inputs[0]).stem().string();
  files.left = inputs[0];
  files.right = inputs[1];
  return {files};
}

std::string remarkOf(const Measurement& measurement) {
  std::string text = shown(measurement.milliseconds, measurement.milliseconds < 100 ? 1 : 0) + " ms";
  if (measurement.all) text = "bad-2 " + shown(measurement.all->errors.badPercent(kBad2), 1) + " %, " + text;
  return text;
}

std::string rangeText(DisparityRange range) {
  return shown(range.low, 1) + " (cold, far) to " + shown(range.high, 1) + " px (warm, near)";
}

struct MethodMap {
  cv::Mat disparity;
  std::string method, remark;
};

// The cells of one scene: left view, truth, and a map per method, all in the colours of one range.
std::vector<SheetCell> cellsOf(const SceneFiles& files, const CompareArguments& arguments,
                               const std::vector<NamedMethod>& methods, Progress& progress) {
  Scene scene;
  {
    const MutedErrorStream muted;
    scene = readScene(files);
  }
  const int num_disparities = disparitiesToSearch(files, scene);
  std::vector<MethodMap> maps;
  for (const NamedMethod& method : methods) {
    progress.show(files.name + ", " + method.name);
    try {
      const MethodResult result =
          runTimed(*method.method, scene, methodOptions(arguments.methods, num_disparities));
      const Measurement measurement = score(files, scene, method.name, num_disparities, result);
      maps.push_back({result.disparity, method.name, remarkOf(measurement)});
    } catch (const std::exception& error) {
      throw std::runtime_error(files.name + ", " + method.name + ": " + error.what());
    }
    progress.stepsDone(1);
  }
  const bool has_truth = !scene.ground_truth.empty();
  const DisparityRange range = typicalRange(has_truth ? scene.ground_truth : maps.front().disparity);
  std::vector<SheetCell> cells = {{toBgr8(scene.left), files.name, rangeText(range)}};
  if (has_truth) cells.push_back({colorizeDisparity(scene.ground_truth, range), "ground truth", ""});
  for (const MethodMap& map : maps)
    cells.push_back({colorizeDisparity(map.disparity, range), map.method, map.remark});
  return cells;
}

void compare(const CompareArguments& arguments) {
  if (extensionOf(arguments.sheet) != ".png")
    throw std::runtime_error("--output is '" + arguments.sheet + "'; allowed extension: .png");
  checkOutputPath(arguments.sheet);
  const std::vector<SceneFiles> scenes = scenesOf(arguments);
  for (const SceneFiles& scene : scenes)
    for (const std::string& input : {scene.left, scene.right, scene.ground_truth})
      if (std::error_code error; fs::equivalent(input, arguments.sheet, error))
        throw std::runtime_error("--output is '" + arguments.sheet + "', which is an input");
  const std::vector<NamedMethod> methods = makeMethods(arguments.methods);

  Progress progress(static_cast<int>(scenes.size() * methods.size()));
  std::vector<std::vector<SheetCell>> rows;
  for (const SceneFiles& scene : scenes) rows.push_back(cellsOf(scene, arguments, methods, progress));
  progress.clear();
  std::size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  if (rows.size() == 1) columns = static_cast<std::size_t>(std::ceil(std::sqrt(columns)));
  std::vector<SheetCell> cells;
  for (auto& row : rows) {
    if (rows.size() > 1) row.resize(columns, {cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(255)), "", ""});
    cells.insert(cells.end(), row.begin(), row.end());
  }
  const int width = rows.size() == 1 ? kOneSceneWidth_px : kSeveralScenesWidth_px;
  const cv::Mat sheet = contactSheet(cells, static_cast<int>(columns), width);
  writeFile(arguments.sheet, encodeImage(sheet));
  std::cout << arguments.sheet << ": " << scenes.size() << (scenes.size() == 1 ? " scene, " : " scenes, ")
            << methods.size() << (methods.size() == 1 ? " method, " : " methods, ") << sheet.cols << " x "
            << sheet.rows << '\n';
}

}  // namespace

void addCompare(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("compare", "Show the maps of several methods side by side");
  const auto arguments = std::make_shared<CompareArguments>();  // lives as long as the callback
  verb->add_option("inputs", arguments->inputs, "LEFT RIGHT, or folders with scenes (see pomona eval)")
      ->required();
  verb->add_option("-o,--output", arguments->sheet, "The sheet (.png): warm is near, black unknown")
      ->required();
  addMethodOptions(*verb, arguments->methods,
                   {"balanced", "quality", "paper", "ssd", "ncc", "asw", "opencv-hh"});
  verb->callback([arguments] { compare(*arguments); });
}

}  // namespace pomona
