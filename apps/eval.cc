#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>

#include "apps/eval_record.h"
#include "apps/measure.h"
#include "apps/method_list.h"
#include "apps/muted_stream.h"
#include "apps/progress.h"
#include "apps/report/report.h"
#include "apps/verbs.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "datasets/atomic_file.h"
#include "datasets/input_file.h"
#include "datasets/submission.h"
#include "datasets/walk.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

struct EvalArguments {
  std::vector<std::string> roots;
  MethodArguments methods;
  std::string mask = "all";
  bool weighted = false;
  std::string json, csv, report, submission;
};

void checkOutputs(const EvalArguments& arguments) {
  const struct {
    const char *option, *extension;
    const std::string& path;
  } kOutputs[] = {{"--json", ".json", arguments.json},
                  {"--csv", ".csv", arguments.csv},
                  {"--report", ".html", arguments.report}};
  for (const auto& output : kOutputs) {
    if (output.path.empty()) continue;
    if (extensionOf(output.path) != output.extension || fs::path(output.path).filename() == "manifest.csv")
      throw std::runtime_error(std::string(output.option) + " is '" + output.path +
                               "'; allowed: a name that ends in " + output.extension +
                               ", other than manifest.csv");
    checkOutputPath(output.path);
  }
  if (!arguments.submission.empty() && fs::exists(arguments.submission) &&
      !fs::is_directory(arguments.submission))
    throw std::runtime_error("--submission is '" + arguments.submission + "', which is no folder");
}

std::string checksOf(const PostProcessing& post) {
  std::string text;
  if (post.left_right_px)
    text += ", --left-right " + shown(*post.left_right_px, *post.left_right_px < 0 ? 0 : 2);
  if (post.speckle_size_px) text += ", --speckle " + std::to_string(*post.speckle_size_px);
  if (post.median_size) text += ", --median " + std::to_string(*post.median_size);
  return text;
}

std::vector<EvalRecord::Fact> factsOf(const EvalArguments& arguments) {
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof(date), "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  const int threads = arguments.methods.threads > 0 ? arguments.methods.threads : availableThreads();
  std::string folders;
  for (const std::string& root : arguments.roots) folders += (folders.empty() ? "" : ", ") + root;
  return {{"date", date},
          {"pomona", POMONA_VERSION},
          {"CPU", std::string(cpuModel())},
          {"instruction set", std::string(name(chooseIsa("")))},
          {"threads", std::to_string(threads)},
          {"OpenCV", CV_VERSION ", " + cv::getCPUFeaturesLine()},
          {"folders", folders},
          {"maps", arguments.methods.mode + checksOf(arguments.methods.post_processing)},
          {"pixels in the table", arguments.mask == "all" ? "all with known truth" : "non-occluded"},
          {"mean over scenes", arguments.weighted ? "Middlebury v3's weights" : "each scene counts the same"},
          {"disparities searched",
           "0 to the data set's bound; without one, to the largest true disparity + 4, rounded up to a "
           "multiple of 16; without truth, to ndisp, or as estimated"},
          {"thresholds", "in pixels of the given images"},
          {"time",
           "wall clock, images in memory to finished maps; of the second run on a pair, if the first took "
           "less than 2 s"}};
}

class Table {
 public:
  explicit Table(const std::vector<SceneFiles>& scenes, const std::vector<NamedMethod>& methods) {
    for (const SceneFiles& scene : scenes) scene_width_ = std::max(scene_width_, scene.name.size());
    for (const NamedMethod& method : methods) method_width_ = std::max(method_width_, method.name.size());
  }
  void begin() const {
    std::string line = cells("scene", "method");
    for (const FigureColumn& column : figureColumns())
      if (column.in_terminal) line += padded(column.name);
    std::cout << line << '\n';
  }
  void add(const std::string& scene, const std::string& method, const std::vector<double>& figures) const {
    std::string line = cells(scene, method);
    for (std::size_t i = 0; i < figures.size(); ++i)
      if (const FigureColumn& column = figureColumns()[i]; column.in_terminal)
        line += padded(shown(figures[i], column.decimals));
    std::cout << line << std::endl;  // row by row: a run may take long
  }

 private:
  static std::string padded(const std::string& text) {
    constexpr std::size_t kWidth = 9;
    return std::string(text.size() < kWidth ? kWidth - text.size() : 1, ' ') + text;
  }
  std::string cells(std::string scene, std::string method) const {
    scene.resize(scene_width_ + 2, ' ');
    method.resize(method_width_, ' ');
    return scene + method;
  }
  std::size_t scene_width_ = std::string_view("mean of 99").size(), method_width_ = 6;
};

/// One run over all scenes. What goes wrong with a scene or method is noted, said, and passed over.
class Evaluation {
 public:
  Evaluation(const EvalArguments& arguments, std::vector<SceneFiles> scenes, std::string remark)
      : arguments_(arguments),
        methods_(makeMethods(arguments.methods)),
        scenes_(std::move(scenes)),
        progress_(static_cast<int>(scenes_.size() * methods_.size())),
        table_(scenes_, methods_) {
    record_.facts = factsOf(arguments);
    for (const NamedMethod& method : methods_) record_.methods.push_back(method.name);
    record_.region = arguments.mask == "all" ? Region::kAll : Region::kNonoccluded;
    record_.weighted = arguments.weighted;
    if (!remark.empty()) record_.remarks.push_back(std::move(remark));
  }

  void run() {
    prepareSubmission();
    table_.begin();
    for (const SceneFiles& files : scenes_) measureScene(files);
    progress_.clear();
    for (const std::string& remark : record_.remarks) std::cerr << "pomona: note: " << remark << '\n';
    if (!record_.measurements.empty())
      for (const std::string& method : record_.methods)
        table_.add(meanName(method), method, record_.meanOfMethod(method, record_.region));
    writeResults();
    if (!record_.problems.empty())
      throw std::runtime_error(std::to_string(failed_scenes_) + " of " + std::to_string(scenes_.size()) +
                               " scenes could not be measured, or not by all methods");
  }

 private:
  std::string meanName(const std::string& method) const {
    const int count = record_.scenesBehindMean(method, record_.region);
    return count == 0 || count == static_cast<int>(scenes_.size()) ? "mean"
                                                                   : "mean of " + std::to_string(count);
  }

  // Before hours of matching, not after.
  void prepareSubmission() const {
    const std::string& folder = arguments_.submission;
    if (folder.empty()) return;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw std::runtime_error("--submission is '" + folder + "': " + error.message());
    checkOutputPath((fs::path(folder) / "any").string());
  }

  void measureScene(const SceneFiles& files) {
    progress_.show(files.name);
    Scene scene;
    int num_disparities = 0;
    try {
      const MutedErrorStream muted;
      scene = readScene(files);
      num_disparities = disparitiesToSearch(files, scene);
      if (!arguments_.report.empty()) report_.addScene(files.name, scene, num_disparities);
    } catch (const std::exception& error) {
      note(files.name + ": " + error.what());
      ++failed_scenes_;
      progress_.stepsDone(static_cast<int>(methods_.size()));
      return;
    }
    remarkOnRange(files, scene);
    const std::size_t problems_before = record_.problems.size();
    for (const NamedMethod& method : methods_) {
      progress_.show(files.name + ", " + method.name);
      try {
        measure(files, scene, method, num_disparities);
      } catch (const std::exception& error) {
        note(files.name + ", " + method.name + ": " + error.what());
      }
      progress_.stepsDone(1);
    }
    failed_scenes_ += record_.problems.size() > problems_before;
  }

  // Scores are clipped to ndisp, so one that is too small makes good maps look bad.
  void remarkOnRange(const SceneFiles& files, const Scene& scene) {
    if (!scene.calibration || scene.ground_truth.empty()) return;
    const int ndisp = scene.calibration->stereo.num_disparities;
    double largest = 0;
    cv::minMaxLoc(scene.ground_truth, nullptr, &largest, nullptr, nullptr,
                  scene.ground_truth == scene.ground_truth);
    if (ndisp > 0 && largest > ndisp)
      record_.remarks.push_back(files.calibration + ": ndisp is " + std::to_string(ndisp) +
                                ", to which disparities are clipped; the truth reaches " + shown(largest, 2));
  }

  void measure(const SceneFiles& files, const Scene& scene, const NamedMethod& method, int num_disparities) {
    const MethodOptions options = methodOptions(arguments_.methods, num_disparities);
    const MethodResult result = runTimed(*method.method, scene, options);
    record_.measurements.push_back(score(files, scene, method.name, num_disparities, result));
    if (!arguments_.report.empty()) report_.addMap(method.name, result.disparity);
    progress_.clear();
    table_.add(files.name, method.name, figuresOf(record_.measurements.back(), record_.region));
    if (!arguments_.submission.empty()) submit(files, method.name, options.mode, result);
  }

  void submit(const SceneFiles& files, const std::string& method, OutputMode mode,
              const MethodResult& result) {
    constexpr double kMsPerS = 1000;
    std::vector<OutputFile> outputs =
        submissionFiles(files, method, mode, result.disparity, result.milliseconds / kMsPerS);
    for (OutputFile& output : outputs) {
      output.path = (fs::path(arguments_.submission) / method / output.path).string();
      fs::create_directories(fs::path(output.path).parent_path());
    }
    writeFiles(outputs);
  }

  void note(std::string problem) {
    problem = printable(std::move(problem));
    progress_.clear();
    std::cerr << "pomona: error: " << problem << '\n';
    record_.problems.push_back(std::move(problem));
  }

  void writeResults() const {
    std::vector<OutputFile> outputs;
    if (!arguments_.json.empty()) outputs.push_back({arguments_.json, jsonOf(record_)});
    if (!arguments_.csv.empty()) outputs.push_back({arguments_.csv, csvOf(record_)});
    if (!arguments_.report.empty()) outputs.push_back({arguments_.report, report_.html(record_)});
    writeFiles(outputs);
  }

  const EvalArguments& arguments_;
  std::vector<NamedMethod> methods_;
  std::vector<SceneFiles> scenes_;
  Progress progress_;
  Table table_;
  EvalRecord record_;
  HtmlReport report_;
  std::size_t failed_scenes_ = 0;
};

// Takes out the scenes that cannot be scored, unless their maps are wanted; says so if there are any.
std::string setAsideUnknown(std::vector<SceneFiles>& scenes, bool wanted) {
  constexpr std::size_t kNamed = 3;
  const auto lacksTruth = [](const SceneFiles& files) {
    return files.ground_truth.empty() && files.problem.empty();
  };
  std::size_t count = 0;
  std::string names;
  for (const SceneFiles& files : scenes)
    if (lacksTruth(files) && ++count <= kNamed) names += (names.empty() ? "" : ", ") + files.name;
  if (count == 0) return "";
  if (!wanted) std::erase_if(scenes, lacksTruth);
  if (scenes.empty())
    throw std::runtime_error("none of the " + std::to_string(count) +
                             " scenes has ground truth; --submission would match them all the same");
  return std::to_string(count) + (count == 1 ? " scene has" : " scenes have") +
         " no ground truth: " + (wanted ? "matched, not scored" : "passed over; --submission would match") +
         " (" + names + (count > kNamed ? ", ...)" : ")");
}

void evaluate(const EvalArguments& arguments) {
  checkOutputs(arguments);
  std::vector<SceneFiles> scenes = findScenes(arguments.roots);
  std::string remark = setAsideUnknown(scenes, !arguments.submission.empty());
  Evaluation(arguments, std::move(scenes), std::move(remark)).run();
}

}  // namespace

void addEval(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("eval", "Measure methods on data sets with known truth");
  const auto arguments = std::make_shared<EvalArguments>();  // lives as long as the callback
  verb->add_option("folders", arguments->roots,
                   "Middlebury, KITTI or ETH3D trees, or folders with a manifest.csv")
      ->required();
  addMethodOptions(*verb, arguments->methods, {"balanced", "quality", "paper", "ssd", "ncc", "opencv-hh"});
  verb->add_option("--mask", arguments->mask,
                   "Pixels that count in the table: all (default) or nocc, seen by both cameras")
      ->check(CLI::IsMember({"all", "nocc"}));
  verb->add_flag("--weighted", arguments->weighted, "Means with the weights of Middlebury v3's table");
  const auto path = [&](const char* option, std::string& value, const char* description) {
    verb->add_option(option, value, description)->check([](const std::string& text) {
      return text.empty() ? std::string("is empty; allowed: a path") : std::string();
    });
  };
  path("--json", arguments->json, "Write all figures (.json)");
  path("--csv", arguments->csv, "Write all figures (.csv)");
  path("--report", arguments->report, "Write a page with tables, curves and maps (.html)");
  path("--submission", arguments->submission,
       "Write the maps below this folder as the benchmarks want them; runs scenes without truth too");
  verb->footer("Errors count in pixels of the given images, so bad-2 at quarter size is bad-8 at full size.");
  verb->callback([arguments] { evaluate(*arguments); });
}

}  // namespace pomona
