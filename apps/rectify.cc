#include "camera/rectify.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/compute_files.h"
#include "apps/muted_stream.h"
#include "apps/rig_options.h"
#include "apps/verbs.h"
#include "core/parallel.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "datasets/middlebury_calib.h"

namespace pomona {
namespace {

struct RectifyArguments {
  std::string left, right, rig, folder;
};

cv::Mat read(const std::string& path) {
  const MutedErrorStream muted;
  return readImage(path);
}

// Pictures of the name that rectified ones get may be raw ones.
void requireOutputs(const RectifyArguments& arguments) {
  checkOutputFolder(arguments.folder);
  if (!std::filesystem::exists(arguments.folder)) return;
  const std::string inputs[] = {arguments.left, arguments.right, arguments.rig};
  std::vector<PlannedOutput> outputs;
  for (const char* name : {"im0.png", "im1.png", "calib.txt"})
    outputs.push_back({"--output", arguments.folder + "/" + name, {".png", ".txt"}});
  checkOutputs(outputs, inputs);
}

void rectify(const RectifyArguments& arguments) {
  requireOutputs(arguments);
  const StereoRig rig = rigNamed(arguments.rig);
  Rectifier rectifier = [&] {
    try {
      return Rectifier(rig);
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(arguments.rig + ": " + e.what());
    }
  }();
  rectifier.rectify(read(arguments.left), read(arguments.right), availableThreads());
  const OutputFile files[] = {
      {"im0.png", encodeImage(rectifier.left())},
      {"im1.png", encodeImage(rectifier.right())},
      {"calib.txt", encodeMiddleburyCalibration(rectifier.calibration())},
  };
  writeFolder(arguments.folder, files);
  std::cout << arguments.folder << ": im0.png im1.png calib.txt, " << rectifier.left().cols << " x "
            << rectifier.left().rows << '\n';
}

}  // namespace

void addRectify(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("rectify", "Rectify a pair (writes Middlebury's layout)");
  const auto arguments = std::make_shared<RectifyArguments>();  // lives as long as the callback
  verb->add_option("left", arguments->left, "Left image, as the camera took it")->required();
  verb->add_option("right", arguments->right, "Right image")->required();
  verb->add_option("--rig", arguments->rig, "The camera (see pomona rig)")->required();
  verb->add_option("-o,--output", arguments->folder, "Folder for the files; made if it is not there")
      ->required();
  verb->callback([arguments] { rectify(*arguments); });
}

}  // namespace pomona
