// Runs all methods on scenes with known truth, and tabulates how wrong they are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#include "bench/accuracy/guard.h"
#include "bench/accuracy/methods.h"
#include "bench/accuracy/report.h"
#include "datasets/walk.h"

namespace pomona {
namespace {

struct Arguments {
  std::string scenes;
  std::string markdown, json, accepted, kept;
  std::vector<std::string> methods;
};

SceneFigures measure(Method& method, const MethodOptions& options, const Scene& scene,
                     const std::string& name) {
  const MethodResult result = method.run(scene.left, scene.right, options);
  SceneFigures figures{name, figuresOf(result, scene.ground_truth), noFigures()};
  if (!scene.nonoccluded.empty())
    figures.nonoccluded = figuresOf(result, scene.ground_truth, scene.nonoccluded);
  return figures;
}

std::vector<MethodFigures> measureAll(const std::vector<Contender>& contenders, const std::string& root) {
  std::vector<MethodFigures> results;
  std::vector<std::unique_ptr<Method>> methods;
  for (const Contender& contender : contenders) {
    results.push_back({contender.name(), contender.kind, {}});
    methods.push_back(makeMethod(contender.method));
  }
  for (const SceneFiles& files : findScenes({root})) {
    const Scene scene = readScene(files);
    // The same range for everybody: what is compared is the matching, not the guessing.
    const int num_disparities = disparitiesToReach(scene.ground_truth);
    if (num_disparities == 0) continue;
    std::fprintf(stderr, "%s\n", files.name.c_str());
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const MethodOptions options = contenders[i].options(num_disparities);
      results[i].scenes.push_back(measure(*methods[i], options, scene, files.name));
    }
  }
  if (results.front().scenes.empty()) throw std::runtime_error(root + ": no scene with known truth found");
  return results;
}

/// `measured`, and the figures in `kept` of whatever was not measured, in the order of the tables.
std::vector<MethodFigures> completed(const std::vector<MethodFigures>& measured,
                                     const std::vector<MethodFigures>& kept) {
  std::vector<MethodFigures> all;
  for (const Contender& contender : contenders())
    for (const auto* source : {&measured, &kept}) {
      const auto found = std::find_if(source->begin(), source->end(), [&](const MethodFigures& figures) {
        return figures.method == contender.name();
      });
      if (found == source->end()) continue;
      all.push_back(*found);
      break;
    }
  return all;
}

void write(const std::string& path, const std::string& text) {
  if (!path.empty() && !(std::ofstream(path) << text << std::flush))
    throw std::runtime_error(path + ": cannot be written");
}

int run(const Arguments& arguments) {
  const bool guarding = !arguments.accepted.empty();
  const std::vector<Contender> compared =
      contenders(guarding && arguments.methods.empty() ? guardedMethods() : arguments.methods);
  const std::vector<MethodFigures> results = measureAll(compared, arguments.scenes);
  const std::vector<MethodFigures> kept =
      arguments.kept.empty() ? std::vector<MethodFigures>() : readFigures(arguments.kept);
  const std::vector<MethodFigures> reported = completed(results, kept);
  const std::string table = markdown(reported);
  std::cout << table;
  write(arguments.markdown, table);
  write(arguments.json, json(reported));
  if (!guarding) return 0;
  const auto failures = accuracyFailures(compared, results, readFigures(arguments.accepted));
  for (const std::string& failure : failures) std::cout << "FAILED: " << failure << "\n";
  return failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  CLI::App app("Accuracy of all methods on scenes in Middlebury's layout");
  app.add_option("scenes", arguments.scenes, "folder below which the scenes lie")->required();
  app.add_option("--markdown", arguments.markdown, "write the tables to this file");
  app.add_option("--json", arguments.json, "write the figures to this file");
  app.add_option("--methods", arguments.methods,
                 "only these methods (default: all; with --guard, the fast ones)")
      ->delimiter(',');
  app.add_option("--keep", arguments.kept, "report the other methods as this earlier --json has them");
  app.add_option("--guard", arguments.accepted,
                 "fail if the figures are worse than those of this earlier --json");
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_accuracy: error: %s\n", error.what());
    return 1;
  }
}
