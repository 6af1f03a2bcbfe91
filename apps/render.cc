#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/verbs.h"
#include "datasets/atomic_file.h"
#include "datasets/chessboard.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "datasets/middlebury_calib.h"
#include "datasets/named_scenes.h"
#include "datasets/pfm.h"
#include "pomona/rig.h"

namespace pomona {
namespace {

struct RenderArguments {
  std::string scene;
  std::uint64_t seed = 1;
  std::string size = "640x480";
  int num_disparities = 0;
  std::string rig;
  int views = 20;
  double square_mm = 20;
  double noise = 2;
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
  const OutputFile files[] = {
      {"im0.png", encodeImage(pair.left.image)},
      {"im1.png", encodeImage(pair.right.image)},
      {"disp0GT.pfm", encodePfm(pair.left.disparity)},
      {"disp1GT.pfm", encodePfm(pair.right.disparity)},
      {"mask0nocc.png", encodeImage(pair.left.mask)},
      {"mask1nocc.png", encodeImage(pair.right.mask)},
      {"calib.txt", encodeMiddleburyCalibration(pair.calibration)},
  };
  writeFolder(folder, files);
}

std::string numbered(const char* name, int number) {
  const std::string digits = std::to_string(number);
  return name + std::string(digits.size() < 2 ? "0" : "") + digits + ".png";
}

// Pictures to calibrate by, and the rig that they should give.
void renderChessboards(const RenderArguments& arguments) {
  if (arguments.rig.empty()) throw std::invalid_argument("chessboard: --rig is missing");
  const StereoRig rig = readRig(arguments.rig);
  const Chessboard board{9, 6, arguments.square_mm / 1000};
  const ChessboardRenderer left(rig.left, board), right(rig.right, board);
  std::vector<OutputFile> files;
  int number = 1;
  for (const BoardPose& pose : scatteredPoses(rig, board, arguments.views, arguments.seed)) {
    const std::uint64_t seed = 2 * (arguments.seed * 1000 + static_cast<std::uint64_t>(number));
    files.push_back({numbered("left", number), encodeImage(left.render(pose, arguments.noise, seed))});
    files.push_back({numbered("right", number),
                     encodeImage(right.render(seenFromRight(rig, pose), arguments.noise, seed + 1))});
    ++number;
  }
  writeFolder(arguments.folder, files);
  std::cout << arguments.folder << ": " << arguments.views << " pairs of a board of 9x6 inner corners, "
            << arguments.square_mm << " mm apart\n";
}

void renderToFolder(const RenderArguments& arguments) {
  if (arguments.scene == "chessboard") return renderChessboards(arguments);
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
  for (const std::string& name : sceneNames()) names += name + ", ";
  verb->add_option("scene", arguments->scene, names + "chessboard")->required();
  verb->add_option("--seed", arguments->seed, "Arrangement and paint (default 1)");
  verb->add_option("--size", arguments->size, "WIDTHxHEIGHT (default 640x480)");
  verb->add_option("--disparities", arguments->num_disparities,
                   "Largest disparity, about (default: width / 10)");
  verb->add_option("--rig", arguments->rig, "chessboard: the camera whose views to draw (see pomona rig)");
  verb->add_option("--views", arguments->views, "chessboard: number of pairs (default 20)")
      ->check(CLI::Range(1, 99));
  verb->add_option("--square", arguments->square_mm, "chessboard: side of a square, mm (default 20)");
  verb->add_option("--noise", arguments->noise, "chessboard: standard deviation, 8-bit units (default 2)")
      ->check(CLI::Range(0.0, 100.0));
  verb->add_option("-o,--output", arguments->folder, "Folder for the files; made if it is not there")
      ->required();
  verb->callback([arguments] { renderToFolder(*arguments); });
}

}  // namespace pomona
