// Runs all methods on scenes with known truth, and tabulates how wrong they are.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "bench/accuracy/guard.h"
#include "bench/accuracy/measure.h"
#include "bench/accuracy/methods.h"
#include "bench/accuracy/report.h"
#include "datasets/atomic_file.h"

namespace pomona {
namespace {

struct Arguments {
  std::string scenes;
  std::string markdown, json, accepted, kept;
  std::vector<std::string> methods;

  bool guards() const { return !accepted.empty(); }
};

/// An entry per contender.
std::vector<MethodFigures> measureAll(const std::vector<Contender>& contenders, const Arguments& arguments,
                                      Failures& failures) {
  std::vector<MethodFigures> results;
  std::vector<std::unique_ptr<Method>> methods;
  for (const Contender& contender : contenders) {
    results.push_back({contender.name(), contender.kind, {}});
    methods.push_back(makeMethod(contender.method));
  }
  forEachScene(arguments.scenes, failures,
               [&](const std::string& name, const Scene& scene, int num_disparities) {
                 for (std::size_t i = 0; i < contenders.size(); ++i)
                   if (!arguments.guards() || isGuardedOn(contenders[i].method, name))
                     results[i].scenes.push_back(
                         measure(*methods[i], contenders[i], name, scene, num_disparities, failures));
               });
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

int run(const Arguments& arguments) {
  std::vector<OutputFile> outputs = plannedOutputs({arguments.markdown, arguments.json});
  const std::vector<MethodFigures> kept =
      arguments.kept.empty() ? std::vector<MethodFigures>() : readFigures(arguments.kept);
  const std::vector<MethodFigures> accepted =
      arguments.guards() ? readFigures(arguments.accepted) : std::vector<MethodFigures>();
  const std::vector<Contender> compared =
      contenders(arguments.guards() && arguments.methods.empty() ? guardedMethods() : arguments.methods);

  Failures failures("pomona_accuracy");
  const std::vector<MethodFigures> measured = measureAll(compared, arguments, failures);
  const std::vector<MethodFigures> reported = completed(measured, kept);
  const std::string table = markdown(reported);
  std::cout << table;
  for (OutputFile& output : outputs) output.bytes = output.path == arguments.json ? json(reported) : table;
  writeFiles(outputs);
  std::vector<std::string> worse;
  if (arguments.guards()) worse = accuracyFailures(compared, measured, accepted);
  for (const std::string& failure : worse) std::cout << "FAILED: " << failure << "\n";
  return worse.empty() && failures.count() == 0 ? 0 : 1;
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
                 "only these methods (default: all; with --guard, without most of OpenCV's)")
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
