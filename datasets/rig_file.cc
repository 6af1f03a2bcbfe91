// readRig(): recognises the format, hands the file to its reader, and checks what all formats have in common.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "datasets/input_file.h"
#include "datasets/middlebury_calib.h"
#include "datasets/rig_formats.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

constexpr double kShortestBaseline_m = 1e-3, kLongestBaseline_m = 10;

std::string readText(const std::string& path) {
  constexpr std::uintmax_t kLargestRigFile = 1 << 20;
  std::error_code error;
  if (fs::file_size(path, error) > kLargestRigFile && !error)
    throw std::runtime_error(path + ": is too large for a calibration; allowed: up to 1 MiB");
  std::string text = readFile(path);
  // yaml-cpp takes some of these for the end of the file.
  const auto isControl = [](unsigned char c) {
    return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
  };
  if (const auto at = std::find_if(text.begin(), text.end(), isControl); at != text.end())
    failAtByte(path, static_cast<std::size_t>(at - text.begin()), "a control character; allowed: text");
  return text;
}

bool isYaml(const std::string& path, const std::string& text) {
  const std::string extension = extensionOf(path);
  return extension == ".yaml" || extension == ".yml" || text.starts_with("%YAML");
}

// The metres in one unit of a file whose format prescribes `prescribed_m`.
double unitOf(const RigFileOptions& options, double prescribed_m) {
  if (!(options.unit_m >= 0) || !std::isfinite(options.unit_m))
    throw std::invalid_argument("unit_m is " + std::to_string(options.unit_m) + "; allowed: 0 or more");
  return options.unit_m > 0 ? options.unit_m : prescribed_m;
}

double openCvUnit(const YamlFields& fields, const RigFileOptions& options) {
  if (!fields.has("length_unit")) return unitOf(options, 1);
  const std::string name = fields.text("length_unit");
  for (const auto& [unit, metres] : {std::pair("m", 1.0), std::pair("cm", 0.01), std::pair("mm", 0.001)})
    if (name == unit) return unitOf(options, metres);
  fields.fail("length_unit", "m, cm or mm");
}

std::string shown(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

void requirePlausible(const StereoRig& rig, const RigFileOptions& options) {
  const double baseline_m = rig.baselineM();
  if (baseline_m >= kShortestBaseline_m && baseline_m <= kLongestBaseline_m) return;
  const std::string guess =
      options.unit_m > 0 ? "its numbers taken in units of " + shown(options.unit_m) + " m, as asked for"
      : baseline_m > kLongestBaseline_m
          ? "perhaps the file counts millimetres: pomona rig convert --unit mm"
          : "perhaps the file counts metres, not millimetres: pomona rig convert --unit m";
  throw std::invalid_argument("baseline is " + shown(baseline_m) + " m; allowed: 0.001 to 10 m (" + guess +
                              ")");
}

// A reader's complaints that don't know their file yet, with the path in front.
template <typename Reader>
StereoRig checked(const std::string& path, const RigFileOptions& options, const Reader& read) {
  try {
    StereoRig rig = read();
    if (std::isfinite(rig.baselineM()) && rig.baselineM() > 0) requirePlausible(rig, options);
    rig.validate();
    return rig;
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

StereoRig fromYaml(const std::string& path, const YamlFields& fields, const RigFileOptions& options) {
  if (fields.has("cam0") || fields.has("cam1")) return rigFromKalibr(fields, options, unitOf(options, 1));
  if (fields.has("M1")) return rigFromOpenCv(fields, fields, openCvUnit(fields, options));
  for (const char* key : {"camera_matrix", "K", "k"})
    if (fields.has(key))
      throw std::runtime_error(path +
                               ": one camera_info; a rig needs the right camera's as well (a second "
                               "path, or a folder with left.yaml and right.yaml)");
  throw std::runtime_error(path +
                           ": no rig; allowed: M1 D1 M2 D2 R T (OpenCV), camera_matrix ... (ROS), or "
                           "cam0 and cam1 (Kalibr)");
}

StereoRig fromMiddlebury(const std::string& path, const RigFileOptions& options) {
  constexpr double kMillimetre_m = 1e-3;
  MiddleburyCalibration calibration = readMiddleburyCalibration(path);
  calibration.stereo.baseline_m *= unitOf(options, kMillimetre_m) / kMillimetre_m;
  return rigOf(calibration.stereo);
}

std::string inFolder(const std::string& folder, const std::string& stem) {
  for (const char* extension : {".yaml", ".yml"}) {
    const fs::path path = fs::path(folder) / (stem + extension);
    if (fs::exists(path)) return path.string();
  }
  throw std::runtime_error(folder + ": no " + stem +
                           ".yaml; allowed: a file, or a folder with left.yaml and "
                           "right.yaml");
}

}  // namespace

StereoRig readRig(const std::string& path, const RigFileOptions& options) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const std::string left = inFolder(path, "left");  // the first one missing is named
    return readRigPair(left, inFolder(path, "right"), options);
  }
  const std::string text = readText(path);
  return checked(path, options, [&] {
    if (isYaml(path, text)) return fromYaml(path, YamlFields::parse(path, text), options);
    if (text.find("cam0") != text.npos && text.find('=') != text.npos) return fromMiddlebury(path, options);
    if (text.find("P0:") != text.npos || text.find("P2:") != text.npos || text.find("P_rect_") != text.npos)
      return rigFromKitti(KeyedFile(path, text, ':'), options, unitOf(options, 1));
    throw std::runtime_error(path +
                             ": no known calibration; allowed: OpenCV or ROS YAML, Kalibr's camchain, "
                             "Middlebury's calib.txt, or KITTI's");
  });
}

StereoRig readRigPair(const std::string& left_path, const std::string& right_path,
                      const RigFileOptions& options) {
  return checked(left_path + ", " + right_path, options, [&] {
    const YamlFields left = YamlFields::parse(left_path, readText(left_path));
    const YamlFields right = YamlFields::parse(right_path, readText(right_path));
    if (left.has("M1")) return rigFromOpenCv(left, right, openCvUnit(right, options));
    return rigFromRos(left, right, unitOf(options, 1));
  });
}

}  // namespace pomona
