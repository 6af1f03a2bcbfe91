// Measures the fruits of rendered orchards with several methods, and tabulates how far off they are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>

#include "baselines/method.h"
#include "bench/accuracy/measure.h"
#include "bench/fruits/tables.h"
#include "datasets/atomic_file.h"
#include "datasets/input_file.h"
#include "datasets/rendering/named_rigs.h"

namespace pomona {
namespace {

// The bands' orchards have seeds of their own, which do not depend on how many there are.
constexpr int kSeedsPerBand = 1000;

struct Arguments {
  int scenes = 30;
  std::uint64_t first_seed = 1001;
  std::string rig = "seed-003";
  std::vector<std::string> methods = {"fast", "balanced", "quality", "paper", "opencv-hh", "ssd", "ncc"};
  std::vector<std::string> earlier;
  std::string markdown, list;
};

// "NAME" or "NAME:SCENES".
FruitMethod parseMethod(const std::string& text, int scenes) {
  const std::size_t colon = text.find(':');
  FruitMethod method{text.substr(0, colon), scenes};
  makeMethod(method.name);  // throws for a name that is not known
  if (colon != text.npos && (!parseNumber(text.substr(colon + 1), method.scenes) || method.scenes < 1))
    throw std::invalid_argument("--methods has '" + text + "'; allowed: NAME or NAME:SCENES");
  return method;
}

// The bands' orchards of one number, by all methods.
void measureScene(const SceneDescription& cameras, std::uint64_t first_seed, int scene,
                  std::vector<FruitMethod>& methods) {
  for (std::size_t band = 0; band < std::size(kBands); ++band) {
    const std::uint64_t seed = first_seed + kSeedsPerBand * band + scene;
    const OrchardPicture picture = takePicture(cameras, kBands[band], seed, usualEffects(seed));
    for (FruitMethod& method : methods) {
      if (scene >= method.scenes) continue;
      const StereoResult map = mapOf(method.name, picture.pair.left.image, picture.pair.right.image,
                                     picture.pair.calibration.num_disparities);
      const std::vector<WaysOfOneFruit> measured = measureFruits(map, picture, seed);
      for (std::size_t i = 0; i < measured.size(); ++i)
        method.fruits[band].push_back(
            {seed, picture.fruits[i].label, picture.fruits[i].visible_share, measured[i]});
    }
  }
}

std::string headOf(const std::string& rig, std::span<const FruitMethod> methods) {
  std::set<std::uint64_t> seeds;
  for (const FruitMethod& method : methods)
    for (const auto& band : method.fruits)
      for (const FruitMethod::Fruit& fruit : band) seeds.insert(fruit.seed);
  if (seeds.empty())
    throw std::runtime_error("there is nothing to report: --scenes is 0 and --add has no fruit");
  const StereoCalibration c = rectificationOf(namedRig(rig)).calibration;
  std::ostringstream out;
  out << "# Distances of fruits\n\nWritten by `pomona_fruits`: " << seeds.size()
      << " rendered orchards, seeds " << *seeds.begin() << " to " << *seeds.rbegin() << ", rig `" << rig
      << "` (" << c.width << "x" << c.height << ", f " << c.focal_px << " px, B " << c.baseline_m * 1000
      << " mm), with noise, blur and a right view that is 3 % brighter. Fruits of which at least "
      << kLeastVisible * 100 << " % are visible; errors without sign.\n\n";
  return out.str();
}

int run(const Arguments& arguments) {
  std::vector<OutputFile> outputs = plannedOutputs({arguments.markdown, arguments.list});
  std::vector<FruitMethod> methods;
  for (const std::string& text : arguments.methods) methods.push_back(parseMethod(text, arguments.scenes));
  for (const std::string& path : arguments.earlier) addFruitList(path, arguments.rig, methods);
  const auto write = [&] {
    for (OutputFile& output : outputs)
      output.bytes = output.path == arguments.list ? fruitList(arguments.rig, methods)
                                                   : headOf(arguments.rig, methods) + fruitTables(methods);
    writeFiles(outputs);
  };
  const SceneDescription cameras = sceneFor(namedRig(arguments.rig));
  for (int scene = 0; scene < arguments.scenes; ++scene) {
    measureScene(cameras, arguments.first_seed, scene, methods);
    write();  // so far: this takes long
    std::fprintf(stderr, "%d of %d\n", scene + 1, arguments.scenes);
  }
  std::cout << headOf(arguments.rig, methods) << fruitTables(methods);
  write();
  return 0;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  CLI::App app("How far off the fruits of rendered orchards are measured");
  app.add_option("--scenes", arguments.scenes,
                 "orchards for each of the three bands of depth (default 30; 0 with --add)")
      ->check(CLI::Range(0, pomona::kSeedsPerBand));
  app.add_option("--first-seed", arguments.first_seed, "seed of the first; the others follow (default 1001)");
  app.add_option("--rig", arguments.rig, "seed-003 (default: 120 mm) or another of pomona render's");
  app.add_option("--methods", arguments.methods,
                 "methods of pomona eval, separated by commas; NAME:SCENES runs one on fewer orchards")
      ->delimiter(',');
  app.add_option("--add", arguments.earlier, "count the measurements of this earlier --list, too");
  app.add_option("--markdown", arguments.markdown, "write the tables to this file");
  app.add_option("--list", arguments.list, "write all measurements to this file, as CSV");
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_fruits: error: %s\n", error.what());
    return 1;
  }
}
