// Errors of depth by distance, on scenes with known truth and calibration.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "baselines/method.h"
#include "bench/accuracy/measure.h"
#include "bench/depth/depth_bins.h"
#include "bench/fruits/measure_fruits.h"

namespace pomona {
namespace {

struct Arguments {
  std::string scenes, markdown;
  std::vector<std::string> methods = {"balanced", "quality", "opencv-hh"};
  double bin_m = 0.5;
};

std::string sectionOf(const std::string& name, const Scene& scene, int num_disparities,
                      const Arguments& arguments) {
  const StereoCalibration& calibration = scene.calibration->stereo;
  std::vector<DepthErrors> all;
  for (const std::string& method : arguments.methods)
    all.push_back({method, depthBins(mapOf(method, scene.left, scene.right, num_disparities),
                                     scene.ground_truth, calibration, arguments.bin_m)});
  std::ostringstream out;
  out << "\n## " << name << ": " << scene.left.cols << "x" << scene.left.rows << ", f "
      << calibration.focal_px << " px, B " << 1000 * calibration.baseline_m << " mm, doffs "
      << calibration.doffs_px << " px\n\n"
      << depthTable(all, calibration);
  return out.str();
}

int run(const Arguments& arguments) {
  for (const std::string& method : arguments.methods) makeMethod(method);  // throws if it is not known
  std::vector<OutputFile> outputs = plannedOutputs({arguments.markdown});
  std::string tables =
      "# Errors of depth\n\nWritten by `pomona_depth`: dense maps, all pixels whose truth is known, by their "
      "true "
      "depth; errors without sign.\n";
  Failures failures("pomona_depth");
  int measured = 0;
  forEachScene(arguments.scenes, failures, [&](const std::string& name, const Scene& scene, int disparities) {
    if (!scene.calibration) return;
    tables += sectionOf(name, scene, disparities, arguments);
    ++measured;
  });
  if (measured == 0) throw std::runtime_error(arguments.scenes + ": no scene has a calib.txt");
  std::cout << tables;
  for (OutputFile& output : outputs) output.bytes = tables;
  writeFiles(outputs);
  return failures.count() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  CLI::App app("Errors of depth by distance, on scenes in Middlebury's layout that have a calib.txt");
  app.add_option("scenes", arguments.scenes, "folder below which the scenes lie")->required();
  app.add_option("--methods", arguments.methods,
                 "methods of pomona eval, separated by commas (default balanced,quality,opencv-hh)")
      ->delimiter(',');
  app.add_option("--bin", arguments.bin_m, "depth of a bin, m (default 0.5)")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--markdown", arguments.markdown, "write the tables to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_depth: error: %s\n", error.what());
    return 1;
  }
}
