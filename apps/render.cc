#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/verbs.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "datasets/middlebury_calib.h"
#include "datasets/named_scenes.h"
#include "datasets/pfm.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  std::string scene;
  std::uint64_t seed = 1;
  std::string size = "640x480";
  int num_disparities = 0;
  std::string folder;
};

cv::Size parseSize(const std::string& text) {
  int width = 0, height = 0;
  const std::size_t x = text.find('x');
  if (x == text.npos || !parseNumber(text.substr(0, x), width) || !parseNumber(text.substr(x + 1), height))
    throw std::invalid_argument("--size is '" + text + "'; allowed: WIDTHxHEIGHT, for example 640x480");
  return {width, height};
}

void writeScene(const std::string& folder, const RenderedPair& pair) {
  const auto pathOf = [&](const char* leaf) { return (fs::path(folder) / leaf).string(); };
  const OutputFile files[] = {
      {pathOf("im0.png"), encodeImage(pair.left.image)},
      {pathOf("im1.png"), encodeImage(pair.right.image)},
      {pathOf("disp0GT.pfm"), encodePfm(pair.left.disparity)},
      {pathOf("disp1GT.pfm"), encodePfm(pair.right.disparity)},
      {pathOf("mask0nocc.png"), encodeImage(pair.left.mask)},
      {pathOf("mask1nocc.png"), encodeImage(pair.right.mask)},
      {pathOf("calib.txt"), encodeMiddleburyCalibration(pair.calibration)},
  };
  std::error_code error;
  const bool created = fs::create_directory(folder, error);
  try {
    writeFiles(files);
  } catch (...) {
    if (created) fs::remove(folder, error);
    throw;
  }
}

void renderToFolder(const RenderArguments& arguments) {
  const cv::Size size = parseSize(arguments.size);
  const RenderedPair pair =
      render(namedScene(arguments.scene, arguments.seed, size.width, size.height, arguments.num_disparities));
  writeScene(arguments.folder, pair);
  std::cout << arguments.folder << ": " << arguments.scene << ", " << size.width << " x " << size.height
            << ", disparities below " << pair.calibration.num_disparities << '\n';
}

}  // namespace

void addRender(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("render", "Render a made-up scene with exact ground truth (Middlebury layout)");
  const auto arguments = std::make_shared<RenderArguments>();  // lives as long as the callback
  std::string names;
  for (const std::string& name : sceneNames()) names += (names.empty() ? "" : ", ") + name;
  verb->add_option("scene", arguments->scene, names)->required();
  verb->add_option("--seed", arguments->seed, "Arrangement and paint (default 1)");
  verb->add_option("--size", arguments->size, "WIDTHxHEIGHT (default 640x480)");
  verb->add_option("--disparities", arguments->num_disparities,
                   "Largest disparity, about (default: width / 10)");
  verb->add_option("-o,--output", arguments->folder, "Folder for the files; made if it is not there")
      ->required();
  verb->callback([arguments] { renderToFolder(*arguments); });
}

}  // namespace pomona
