#include "camera/calibrate.h"

#include <glob.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/compute_files.h"
#include "apps/muted_stream.h"
#include "apps/print.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "datasets/input_file.h"

namespace pomona {
namespace {

struct CalibrateArguments {
  std::string left, right;  // patterns
  std::string board = "9x6";
  std::string square;
  std::string output;
  std::string coverage;
  bool rational = false;
};

BoardSize parseBoard(const CalibrateArguments& arguments) {
  BoardSize board;
  const std::string& text = arguments.board;
  const std::size_t x = text.find('x');
  if (x == text.npos || !parseNumber(text.substr(0, x), board.columns) ||
      !parseNumber(text.substr(x + 1), board.rows))
    throw std::invalid_argument("--board is " + pomona::quoted(text) +
                                "; allowed: inner corners as COLUMNSxROWS, for example 9x6");
  const std::string& square = arguments.square;
  const std::size_t unit = std::min(square.find_first_of("cm"), square.size());
  const std::string name = square.substr(unit);
  const double unit_m = name == "mm" ? 0.001 : name == "cm" ? 0.01 : name == "m" ? 1 : 0;
  constexpr double kSmallest_m = 0.001, kLargest_m = 1;
  const bool parsed = parseNumber(square.substr(0, unit), board.square_m);
  board.square_m *= unit_m;
  if (!parsed || !(board.square_m >= kSmallest_m && board.square_m <= kLargest_m))
    throw std::invalid_argument(
        "--square is " + pomona::quoted(square) +
        "; allowed: a length from 1mm to 1m with its unit (mm, cm or m), for example 20mm");
  return board;
}

std::vector<std::string> filesLike(const std::string& pattern) {
  ::glob_t found{};
  const int status = ::glob(pattern.c_str(), 0, nullptr, &found);  // in alphabetical order
  std::vector<std::string> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (status != 0) throw std::invalid_argument("no file matches " + pomona::quoted(pattern));
  return files;
}

// What tells the pairs apart: the digits of a file's name.
std::string numberOf(const std::string& path) {
  std::string digits;
  for (const char c : std::filesystem::path(path).stem().string())
    if (c >= '0' && c <= '9') digits += c;
  return digits;
}

using Pair = std::pair<std::string, std::string>;

std::vector<Pair> pairsOf(const CalibrateArguments& arguments) {
  const std::vector<std::string> left = filesLike(arguments.left), right = filesLike(arguments.right);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
    if (i >= left.size() || i >= right.size() || numberOf(left[i]) != numberOf(right[i]))
      throw std::invalid_argument(std::to_string(left.size()) + " left and " + std::to_string(right.size()) +
                                  " right images don't pair up: " + (i < left.size() ? left[i] : "none") +
                                  " and " + (i < right.size() ? right[i] : "none") + " (number " +
                                  std::to_string(i + 1) + ") don't belong together");
    pairs.emplace_back(left[i], right[i]);
  }
  return pairs;
}

cv::Mat readImage8(const std::string& path) {
  const MutedErrorStream muted;
  cv::Mat image = readImage(path);
  // 16-bit pictures have all the contrast that corners need in their upper byte, once stretched.
  if (image.depth() == CV_16U) {
    double largest = 0;
    cv::minMaxIdx(image.reshape(1), nullptr, &largest);
    image.convertTo(image, CV_8U, 255 / std::max(1.0, largest));
  }
  return image;
}

std::vector<BoardView> findBoards(const std::vector<Pair>& pairs, const BoardSize& board,
                                  cv::Size& image_size) {
  std::vector<BoardView> views;
  Progress progress(static_cast<int>(pairs.size()));
  for (const auto& [left_path, right_path] : pairs) {
    progress.show(left_path);
    const std::string name = std::filesystem::path(left_path).filename().string();
    cv::Mat left, right;
    try {
      left = readImage8(left_path);
      right = readImage8(right_path);
    } catch (const std::runtime_error& e) {  // one bad file of many
      views.push_back({name, {}, {}, e.what()});
      progress.stepsDone(1);
      continue;
    }
    if (image_size.empty()) image_size = left.size();
    if (left.size() != image_size)
      throw std::invalid_argument(left_path + ": is " + std::to_string(left.cols) + "x" +
                                  std::to_string(left.rows) + "; allowed: the size of the first, " +
                                  std::to_string(image_size.width) + "x" + std::to_string(image_size.height));
    views.push_back(findBoard(name, left, right, board));
    progress.stepsDone(1);
  }
  if (image_size.empty()) throw std::runtime_error(views.front().rejected);
  return views;
}

void printCamera(const char* name, const CameraModel& c, const CameraDeviation& d) {
  print("%s f %.2f %.2f +- %.2f %.2f px  c %.2f %.2f +- %.2f %.2f px", name, c.fx_px, c.fy_px, d.fx_px,
        d.fy_px, c.cx_px, c.cy_px, d.cx_px, d.cy_px);
  const char* const names[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  for (std::size_t i = 0; i < c.distortion.size(); ++i)
    if (c.distortion[i] != 0 || d.distortion[i] != 0)
      print("           %s %9.5f +- %.5f", names[i], c.distortion[i], d.distortion[i]);
}

void printReport(const CalibrationReport& report) {
  print("view                      rms px  epipolar px");
  for (const CalibrationReport::View& view : report.views) {
    if (view.rejected.empty())
      print("%-24s %7.3f %12.3f", view.name.c_str(), view.rms_px, view.epipolar_px);
    else
      print("%-24s rejected: %s", view.name.c_str(), view.rejected.c_str());
  }
  const StereoRig& rig = report.rig;
  const cv::Vec3d &t = rig.right_from_left_m, &dt = report.translation_deviation_m;
  print("views      %d of %zu used", report.used_views, report.views.size());
  print("rms        %.4f px", report.rms_px);
  print("epipolar   mean %.3f px, P95 %.3f px after rectification", report.epipolar_mean_px,
        report.epipolar_p95_px);
  printCamera("left      ", rig.left, report.left_deviation);
  printCamera("right     ", rig.right, report.right_deviation);
  print("baseline   %.3f +- %.3f mm  (T %.3f %.3f %.3f +- %.3f %.3f %.3f mm)", 1e3 * rig.baselineM(),
        1e3 * report.baseline_deviation_m, 1e3 * t[0], 1e3 * t[1], 1e3 * t[2], 1e3 * dt[0], 1e3 * dt[1],
        1e3 * dt[2]);
  print("coverage   left %.0f %%, right %.0f %%", 100 * report.left_coverage, 100 * report.right_coverage);
  for (const std::string& warning : report.warnings) print("warning    %s", warning.c_str());
}

void requireOutputs(const CalibrateArguments& arguments, const std::vector<Pair>& pairs) {
  std::vector<PlannedOutput> outputs = {{"--output", arguments.output, {".yml", ".yaml"}}};
  if (!arguments.coverage.empty()) outputs.push_back({"--coverage", arguments.coverage, {".png"}});
  std::vector<std::string> pictures;
  for (const auto& [left, right] : pairs) pictures.insert(pictures.end(), {left, right});
  checkOutputs(outputs, pictures);
}

void calibrate(const CalibrateArguments& arguments) {
  const BoardSize board = parseBoard(arguments);
  const std::vector<Pair> pairs = pairsOf(arguments);
  requireOutputs(arguments, pairs);
  cv::Size image_size;
  const std::vector<BoardView> views = findBoards(pairs, board, image_size);
  if (!arguments.coverage.empty())
    writeFile(arguments.coverage, encodeImage(coveragePicture(views, image_size)));
  const CalibrationReport report =
      calibrateStereo(views, image_size, board, {.rational = arguments.rational});
  writeRig(arguments.output, report.rig);
  printReport(report);
}

}  // namespace

void addCalibrate(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("calibrate", "Calibrate a stereo camera from pictures of a chessboard");
  const auto arguments = std::make_shared<CalibrateArguments>();  // lives as long as the callback
  verb->add_option("left", arguments->left, "Left pictures, as a quoted pattern: 'left*.jpg'")->required();
  verb->add_option("right", arguments->right, "Right pictures; pairs go by the digits of the names")
      ->required();
  verb->add_option("--board", arguments->board, "Inner corners, COLUMNSxROWS (default 9x6)");
  verb->add_option("--square", arguments->square, "Side of a square with its unit, for example 20mm")
      ->required();
  verb->add_option("-o,--output", arguments->output, "The rig (.yml)")->required();
  verb->add_option("--coverage", arguments->coverage, "Picture of where the corners were (.png)");
  verb->add_flag("--rational", arguments->rational, "8 distortion coefficients, for wide lenses (default 5)");
  verb->callback([arguments] { calibrate(*arguments); });
}

}  // namespace pomona
