#include "pomona/rig.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/print.h"
#include "apps/rig_options.h"
#include "apps/verbs.h"
#include "datasets/rendering/named_rigs.h"

namespace pomona {
namespace {

struct RigArguments {
  RigPaths rig;
  std::string output;
  std::string format = "pomona";
};

void printCamera(const char* name, const CameraModel& c) {
  print("%s  f %.3f %.3f px  c %.3f %.3f px", name, c.fx_px, c.fy_px, c.cx_px, c.cy_px);
  const auto& k = c.distortion;
  if (c.distortion_model == DistortionModel::kFisheye)
    print("             fisheye k1 %.6g  k2 %.6g  k3 %.6g  k4 %.6g", k[0], k[1], k[2], k[3]);
  else if (c.isDistorted())
    print("             k1 %.6g  k2 %.6g  p1 %.6g  p2 %.6g  k3 %.6g", k[0], k[1], k[2], k[3], k[4]);
  if (k[5] != 0 || k[6] != 0 || k[7] != 0) print("             k4 %.6g  k5 %.6g  k6 %.6g", k[5], k[6], k[7]);
}

void show(const RigArguments& arguments) {
  const StereoRig rig = readRig(arguments.rig);
  if (rig.left.width > 0)
    print("size         %d x %d", rig.left.width, rig.left.height);
  else
    print("size         unknown");
  printCamera("left       ", rig.left);
  printCamera("right      ", rig.right);
  const cv::Vec3d& t = rig.right_from_left_m;
  const double trace = cv::trace(rig.right_from_left_rotation);
  constexpr double kDegrees = 180 / CV_PI;
  print("baseline     %.6g m  (T %.6g %.6g %.6g)", rig.baselineM(), t[0], t[1], t[2]);
  print("turned by    %.4f degrees", kDegrees * std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)));
  if (!rig.rectification && !rig.isRectified() && rig.left.width == 0) {
    print("rectified    cannot be said without the images' size");
    return;
  }
  const StereoCalibration c = rectificationOf(rig).calibration;
  print("rectified    %s", rig.isRectified()   ? "as the cameras see it"
                           : rig.rectification ? "as the file states"
                                               : "by pomona: the file states no rectification");
  print("             f %.3f px  c %.3f %.3f px  doffs %.3f px  baseline %.6g m", c.focal_px, c.cx_px,
        c.cy_px, c.doffs_px, c.baseline_m);
  if (c.width > 0 && (c.width != rig.left.width || c.height != rig.left.height))
    print("             %d x %d", c.width, c.height);
  for (const double depth_m : {0.5, 1.0, 2.0, 5.0, 10.0})
    print("at %4.1f m    %.2f px", depth_m, c.focal_px * c.baseline_m / depth_m - c.doffs_px);
}

void convert(const RigArguments& arguments) {
  const std::map<std::string, RigFormat> formats = {
      {"pomona", RigFormat::kPomona}, {"ros", RigFormat::kRos}, {"middlebury", RigFormat::kMiddlebury}};
  writeRig(arguments.output, readRig(arguments.rig), formats.at(arguments.format));
  std::cout << arguments.output << ": " << arguments.format << '\n';
}

}  // namespace

void addRigPaths(CLI::App& verb, RigPaths& paths) {
  verb.add_option(
          "rig", paths.files,
          "Calibration: OpenCV or ROS YAML, Kalibr's camchain, Middlebury's calib.txt, KITTI's; two files "
          "where left and right have one each, or the folder with left.yaml and right.yaml; or a rig of "
          "pomona render's, such as seed-003")
      ->required()
      ->expected(1, 2);
  verb.add_option("--unit", paths.unit, "Unit of its lengths, if not the one of its format: m, cm or mm")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  verb.add_option("--cameras", paths.cameras,
                  "Left and right, in a file with several (default: Kalibr 0 1, KITTI 2 3)")
      ->expected(2)
      ->check(CLI::Range(0, 99));
}

StereoRig rigNamed(const std::string& name_or_path, const RigFileOptions& options) {
  const std::vector<std::string> names = rigNames();
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) return namedRig(name_or_path);
  std::error_code error;
  if (!std::filesystem::exists(name_or_path, error))
    throw std::runtime_error(
        name_or_path + ": cannot be read: no such file; allowed: one, or a rig's name: " + listText(names));
  return readRig(name_or_path, options);
}

StereoRig readRig(const RigPaths& paths) {
  RigFileOptions options;
  if (!paths.unit.empty()) options.unit_m = paths.unit == "m" ? 1 : paths.unit == "cm" ? 0.01 : 0.001;
  if (!paths.cameras.empty()) {
    options.left_camera = paths.cameras[0];
    options.right_camera = paths.cameras[1];
    if (paths.cameras[0] == paths.cameras[1])
      throw std::invalid_argument("--cameras is " + std::to_string(paths.cameras[0]) +
                                  " twice; allowed: two different ones");
  }
  return paths.files.size() == 2 ? readRigPair(paths.files[0], paths.files[1], options)
                                 : rigNamed(paths.files[0], options);
}

void addRig(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("rig", "Show or convert the calibration of a stereo camera");
  verb->require_subcommand(1);
  const auto arguments = std::make_shared<RigArguments>();  // lives as long as the callbacks
  CLI::App* show_verb = verb->add_subcommand("show", "Print it, with what it is once rectified");
  addRigPaths(*show_verb, arguments->rig);
  show_verb->callback([arguments] { show(*arguments); });
  CLI::App* convert_verb = verb->add_subcommand("convert", "Write it in another format");
  addRigPaths(*convert_verb, arguments->rig);
  convert_verb->add_option("-o,--output", arguments->output, "File; for ros the folder")->required();
  convert_verb
      ->add_option(
          "--to", arguments->format,
          "pomona (default; OpenCV's YAML), ros (left.yaml, right.yaml) or middlebury (rectified only)")
      ->check(CLI::IsMember({"pomona", "ros", "middlebury"}));
  convert_verb->callback([arguments] { convert(*arguments); });
}

}  // namespace pomona
