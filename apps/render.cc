// `pomona render`: options to scene descriptions, scenes to files.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/print.h"
#include "apps/rig_options.h"
#include "apps/scene_files.h"
#include "apps/verbs.h"
#include "datasets/chessboard.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"
#include "datasets/named_scenes.h"
#include "datasets/rendering/indoor.h"
#include "datasets/rendering/named_rigs.h"
#include "datasets/rendering/require_range.h"
#include "datasets/rig_formats.h"
#include "pomona/rig.h"

namespace pomona {
namespace {

struct RenderArguments {
  std::string scene;
  std::uint64_t seed = 1;
  std::string rig, size;
  int num_disparities = 0;
  OrchardOptions orchard;
  StorefrontOptions storefront;
  IndoorOptions indoor;
  CameraEffects effects;
  double right_shift_px = 0;
  bool lens = false;
  int bits = 8;
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

// "A..B", or "A" for both.
void parseRange(const std::string& option, const std::string& text, double& low, double& high) {
  const std::size_t dots = text.find("..");
  const std::string first = text.substr(0, dots), last = dots == text.npos ? first : text.substr(dots + 2);
  if (!parseNumber(first, low) || !parseNumber(last, high))
    throw std::invalid_argument(option + " is '" + text + "'; allowed: FROM..TO, for example 0.6..0.75");
}

StereoRig rigOf(const RenderArguments& arguments) {
  const StereoRig rig = rigNamed(arguments.rig);
  if (rig.left.width == 0)
    throw std::invalid_argument(arguments.rig +
                                ": the rig's image size is unknown; allowed: a rig with it, to render by");
  if (arguments.size.empty()) return rig;
  const cv::Size size = parseSize(arguments.size);
  return resized(rig, size.width, size.height);
}

std::string numbered(const char* name, int number) {
  const std::string digits = std::to_string(number);
  return name + std::string(digits.size() < 2 ? "0" : "") + digits + ".png";
}

// Pictures to calibrate by, and the rig that they should give.
void renderChessboards(const RenderArguments& arguments) {
  if (arguments.rig.empty()) throw std::invalid_argument("chessboard: --rig is missing");
  requireRange("--square", arguments.square_mm, 0.1, 10'000);
  requireRange("--noise", arguments.noise, 0, 100);
  const StereoRig rig = rigOf(arguments);
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

// The scene that pictures are taken of: what the scene's own maker left open.
void finish(const RenderArguments& arguments, SceneDescription& scene) {
  scene.bits = arguments.bits;
  if (arguments.lens) takeThroughLenses(rigOf(arguments), scene);
  if (arguments.right_shift_px != 0) shiftRightView(arguments.right_shift_px, scene);
}

SceneDescription namedSceneFor(const RenderArguments& arguments) {
  if (!arguments.rig.empty())
    return namedScene(arguments.scene, arguments.seed, sceneFor(rigOf(arguments)), arguments.num_disparities);
  const cv::Size size = parseSize(arguments.size.empty() ? "640x480" : arguments.size);
  return namedScene(arguments.scene, arguments.seed, size.width, size.height, arguments.num_disparities);
}

void renderToFolder(RenderArguments arguments) {
  checkOutputFolder(arguments.folder);
  if (arguments.scene == "chessboard") return renderChessboards(arguments);
  const bool has_rig =
      arguments.scene == "orchard" || arguments.scene == "storefront" || arguments.scene == "indoor";
  if (has_rig && arguments.rig.empty()) arguments.rig = "seed-003";
  if (arguments.lens && arguments.rig.empty()) throw std::invalid_argument("--lens needs --rig");
  arguments.effects.noise_seed = arguments.orchard.seed = arguments.storefront.seed = arguments.seed;
  arguments.indoor.seed = arguments.seed;

  RenderedPair pair;
  std::vector<OutputFile> lists;
  if (arguments.scene == "orchard") {
    Orchard trees = orchard(sceneFor(rigOf(arguments)), arguments.orchard);
    finish(arguments, trees.scene);
    pair = render(trees.scene, arguments.effects);
    lists = fruitFiles(trees, pair);
  } else if (arguments.scene == "storefront") {
    Storefront street = storefront(sceneFor(rigOf(arguments)), arguments.storefront);
    finish(arguments, street.scene);
    pair = render(street.scene, arguments.effects);
    lists = signFiles(street, pair);
  } else if (arguments.scene == "indoor") {
    SceneDescription room = indoor(sceneFor(rigOf(arguments)), arguments.indoor).scene;
    finish(arguments, room);
    pair = render(room, arguments.effects);
  } else {
    SceneDescription scene = namedSceneFor(arguments);
    finish(arguments, scene);
    pair = render(scene, arguments.effects);
  }
  std::vector<OutputFile> files = pairFiles(pair);
  files.insert(files.end(), lists.begin(), lists.end());
  if (arguments.lens) files.push_back({"rig.yml", encodeRig(rigOf(arguments))});
  writeFolder(arguments.folder, files);
  std::cout << arguments.folder << ": " << arguments.scene << ", " << pair.calibration.width << " x "
            << pair.calibration.height << ", disparities below " << pair.calibration.num_disparities << '\n';
}

// Those of sceneNames(), and those that have a maker of their own.
std::vector<std::string> allSceneNames() {
  std::vector<std::string> names = {"orchard", "storefront", "indoor", "chessboard"};
  for (const std::string& name : sceneNames()) names.push_back(name);
  return names;
}

void requireKnownScene(const std::string& scene) {
  const std::vector<std::string> names = allSceneNames();
  if (std::find(names.begin(), names.end(), scene) == names.end())
    throw std::invalid_argument("scene is '" + scene + "'; allowed: " + listText(names));
}

// Options that only some scenes know are refused for the others.
void requireKnownOptions(const CLI::App& verb, const std::string& scene) {
  const struct {
    const char* option;
    std::vector<std::string> scenes;
  } kOnlyFor[] = {{"--distance", {"orchard", "storefront", "indoor"}},
                  {"--contrast", {"indoor"}},
                  {"--fruits", {"orchard"}},
                  {"--walls", {"storefront"}},
                  {"--yaw", {"storefront"}},
                  {"--disparities", sceneNames()},
                  {"--views", {"chessboard"}},
                  {"--square", {"chessboard"}},
                  {"--noise", {"chessboard"}}};
  for (const auto& [option, scenes] : kOnlyFor)
    if (verb.count(option) > 0 && std::find(scenes.begin(), scenes.end(), scene) == scenes.end())
      throw std::invalid_argument(std::string(option) + " is no option of the scene '" + scene + "'");
  if (scene != "chessboard") return;
  for (const char* option : {"--blur", "--vignetting", "--exposure", "--right-gain", "--shot-noise",
                             "--read-noise", "--right-shift", "--lens", "--bits"})
    if (verb.count(option) > 0)
      throw std::invalid_argument(std::string(option) + " is no option of the scene 'chessboard'");
}

void addSceneOptions(CLI::App& verb, RenderArguments& a) {
  const auto setDistance = [&a](const std::string& text) {
    parseRange("--distance", text, a.orchard.nearest_m, a.orchard.farthest_m);
    a.storefront.nearest_m = a.orchard.nearest_m;
    a.storefront.farthest_m = a.indoor.farthest_m = a.orchard.farthest_m;
    a.indoor.nearest_m = a.orchard.nearest_m;
  };
  const auto setYaw = [&a](const std::string& text) {
    parseRange("--yaw", text, a.storefront.least_yaw_deg, a.storefront.greatest_yaw_deg);
  };
  verb.add_option_function<std::string>("--distance", setDistance,
                                        "orchard: depths of the fruits, m (default 0.6..0.75); storefront: "
                                        "of the walls (default 2..5); indoor: of the boxes "
                                        "(default 1.8..4)");
  verb.add_option("--contrast", a.indoor.contrast,
                  "indoor: by how much floor and wall vary, 8-bit units (default 14)");
  verb.add_option("--fruits", a.orchard.fruits, "orchard: number of fruits (default: 6 to 14)");
  verb.add_option("--walls", a.storefront.walls, "storefront: number of walls (default 3)");
  verb.add_option_function<std::string>("--yaw", setYaw,
                                        "storefront: turn of the walls, degrees (default -45..45)");
  verb.add_option("--views", a.views, "chessboard: number of pairs (default 20)")->check(CLI::Range(1, 99));
  verb.add_option("--square", a.square_mm, "chessboard: side of a square, mm (default 20)");
  verb.add_option("--noise", a.noise, "chessboard: standard deviation, 8-bit units (default 2)");
}

void addCameraOptions(CLI::App& verb, RenderArguments& a) {
  verb.add_option("--rig", a.rig,
                  listText(rigNames()) +
                      ", or a file (see pomona rig); default for orchard, storefront and indoor: seed-003");
  verb.add_option("--size", a.size, "WIDTHxHEIGHT; default: the rig's, without one 640x480");
  verb.add_option("--disparities", a.num_disparities, "Largest disparity, about (default: width / 10)");
  verb.add_option("--blur", a.effects.blur_px, "Standard deviation of the blur, pixels");
  verb.add_option("--vignetting", a.effects.vignetting, "Share of the light lost in the corners, 0 to 1");
  verb.add_option("--exposure", a.effects.exposure, "Factor on the light of both views");
  verb.add_option("--right-gain", a.effects.right_gain, "Factor on the values of the right view");
  verb.add_option("--shot-noise", a.effects.shot_noise, "Standard deviation at white, 8-bit units");
  verb.add_option("--read-noise", a.effects.read_noise, "Standard deviation anywhere, 8-bit units");
  verb.add_option("--right-shift", a.right_shift_px, "Rows by which the right picture lies too high");
  verb.add_flag("--lens", a.lens, "Take the pictures through the rig's lenses; also writes rig.yml");
  verb.add_option("--bits", a.bits, "Of the pictures: 8 (default) or 16");
}

}  // namespace

void addRender(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("render", "Render a made-up scene with exact ground truth (Middlebury layout)");
  const auto arguments = std::make_shared<RenderArguments>();  // lives as long as the callback
  verb->add_option("scene", arguments->scene, listText(allSceneNames()))->required();
  // CLI11 takes -1, and what does not fit, for the largest number there is.
  const auto isSeed = [](const std::string& text) -> std::string {
    constexpr std::size_t kDigits = 18;
    const bool good = text.size() <= kDigits && text.find_first_not_of("0123456789") == text.npos;
    return good ? "" : "is '" + text + "'; allowed: a whole number of up to 18 digits, 0 or above";
  };
  verb->add_option("--seed", arguments->seed, "Arrangement, paint and noise (default 1)")->check(isSeed);
  addSceneOptions(*verb, *arguments);
  addCameraOptions(*verb, *arguments);
  verb->add_option("-o,--output", arguments->folder, "Folder for the files; made if it is not there")
      ->required();
  verb->callback([verb, arguments] {
    requireKnownScene(arguments->scene);
    requireKnownOptions(*verb, arguments->scene);
    renderToFolder(*arguments);
  });
}

}  // namespace pomona
