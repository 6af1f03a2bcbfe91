#include "bench/accuracy/measure.h"

#include <cstdio>
#include <stdexcept>

#include "datasets/walk.h"

namespace pomona {

void Failures::note(const std::string& what, const std::exception& error) {
  std::fprintf(stderr, "%s: error: %s: %s\n", program_.c_str(), what.c_str(), error.what());
  ++count_;
}

void forEachScene(const std::string& folder, Failures& failures, const SceneVisitor& visit) {
  bool any = false;
  for (const SceneFiles& files : findScenes({folder})) {
    Scene scene;
    try {
      scene = readScene(files);
    } catch (const std::exception& error) {
      failures.note(files.name, error);
      continue;
    }
    const int num_disparities = disparitiesToReach(scene.ground_truth);
    if (num_disparities == 0) continue;
    std::fprintf(stderr, "%s\n", files.name.c_str());
    visit(files.name, scene, num_disparities);
    any = true;
  }
  if (!any) throw std::runtime_error(folder + ": no scene with known truth could be read");
}

std::vector<OutputFile> plannedOutputs(std::initializer_list<std::string> paths) {
  std::vector<OutputFile> outputs;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    checkOutputPath(path);
    outputs.push_back({path, ""});
  }
  return outputs;
}

SceneFigures sceneFigures(const std::string& name, const Scene& scene, const MethodResult& result) {
  SceneFigures figures{name, figuresOf(result, scene.ground_truth), noFigures()};
  if (!scene.nonoccluded.empty())
    figures.nonoccluded = figuresOf(result, scene.ground_truth, scene.nonoccluded);
  return figures;
}

SceneFigures measure(Method& method, const Contender& contender, const std::string& name, const Scene& scene,
                     int num_disparities, Failures& failures) {
  try {
    return sceneFigures(name, scene, method.run(scene.left, scene.right, contender.options(num_disparities)));
  } catch (const std::exception& error) {
    failures.note(name + ", " + contender.name(), error);
    return {name, noFigures(), noFigures()};
  }
}

}  // namespace pomona
