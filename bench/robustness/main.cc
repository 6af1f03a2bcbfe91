// Runs the presets and their peer on scenes whose right views were changed, and tabulates what it does to
// their maps.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>

#include "bench/accuracy/measure.h"
#include "bench/robustness/changes.h"
#include "bench/robustness/tables.h"
#include "datasets/atomic_file.h"

namespace pomona {
namespace {

struct Arguments {
  std::string scenes, markdown, json;
};

std::vector<Contender> denseContenders() {
  const std::vector<std::string> names = {"fast", "balanced", "quality", kPeer};
  std::vector<Contender> dense = contenders(names);
  std::erase_if(dense, [](const Contender& contender) { return contender.kind != MapKind::kDense; });
  return dense;
}

std::vector<ChangedFigures> measureAll(const std::string& folder, Failures& failures) {
  const std::vector<Contender> compared = denseContenders();
  std::vector<ChangedFigures> results;
  for (const Change& change : changes()) {
    results.push_back({change.name, {}});
    for (const Contender& contender : compared)
      results.back().methods.push_back({contender.name(), contender.kind, {}});
  }
  forEachScene(folder, failures, [&](const std::string& name, const Scene& scene, int num_disparities) {
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const std::unique_ptr<Method> method = makeMethod(compared[i].method);
      for (std::size_t k = 0; k < results.size(); ++k) {
        Scene changed = scene;
        changed.right = changes()[k].apply(scene.right);
        results[k].methods[i].scenes.push_back(
            measure(*method, compared[i], name, changed, num_disparities, failures));
      }
    }
  });
  return results;
}

int run(const Arguments& arguments) {
  std::vector<OutputFile> outputs = plannedOutputs({arguments.markdown, arguments.json});
  Failures failures("pomona_robustness");
  const std::vector<ChangedFigures> results = measureAll(arguments.scenes, failures);
  const std::string tables = robustnessMarkdown(results);
  std::cout << tables;
  for (OutputFile& output : outputs)
    output.bytes = output.path == arguments.json ? robustnessJson(results) : tables;
  writeFiles(outputs);
  return failures.count() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  CLI::App app("Robustness against differences between the cameras, on scenes in Middlebury's layout");
  app.add_option("scenes", arguments.scenes, "folder below which the scenes lie")->required();
  app.add_option("--markdown", arguments.markdown, "write the tables to this file");
  app.add_option("--json", arguments.json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_robustness: error: %s\n", error.what());
    return 1;
  }
}
