#include "datasets/middlebury_calib.h"

#include <array>
#include <cmath>
#include <string_view>

#include "datasets/keyed_file.h"

namespace pomona {
namespace {

struct Camera {
  double focal_px, cx_px, cy_px;
};

template <typename Number>
std::optional<Number> optionalNumber(const KeyedFile& file, std::string_view key, Number smallest,
                                     Number largest) {
  return file.has(key) ? std::optional(file.number(key, smallest, largest)) : std::nullopt;
}

// [f 0 cx; 0 f cy; 0 0 1]
Camera camera(const KeyedFile& file, std::string_view key) {
  std::array<double, 9> k{};
  const std::string_view text = file.text(key);
  const bool rectified = text.starts_with('[') && text.ends_with(']') &&
                         parseNumbers(text.substr(1, text.size() - 2), " \t;,", k) && k[0] > 0 &&
                         k[0] == k[4] && k[1] == 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (!rectified) file.fail(key, "[f 0 cx; 0 f cy; 0 0 1] with f > 0");
  return {k[0], k[2], k[5]};
}

}  // namespace

MiddleburyCalibration readMiddleburyCalibration(const std::string& path) {
  constexpr int kLargestSize = 1 << 20;
  constexpr double kLargestOffset = 1 << 20, kLargestContradiction_px = 0.5;
  constexpr double kSmallestBaseline_mm = 1e-3, kLargestBaseline_mm = 1e9, kMmPerM = 1000;
  const KeyedFile file(path, readFile(path), '=');
  file.require("cam0");
  file.require("baseline");

  MiddleburyCalibration result;
  const Camera left = camera(file, "cam0");
  result.stereo.focal_px = left.focal_px;
  result.stereo.cx_px = left.cx_px;
  result.stereo.cy_px = left.cy_px;
  result.stereo.baseline_m = file.number("baseline", kSmallestBaseline_mm, kLargestBaseline_mm) / kMmPerM;
  if (file.has("cam1")) {
    const Camera right = camera(file, "cam1");
    if (std::abs(right.focal_px - left.focal_px) > 1e-3 * left.focal_px)
      file.fail("cam1", "the focal length of cam0, for a rectified pair");
    if (std::abs(right.cy_px - left.cy_px) > kLargestContradiction_px)
      file.fail("cam1", "cy of cam0, for a rectified pair");
    result.stereo.doffs_px = right.cx_px - left.cx_px;
  }
  if (file.has("doffs")) {
    const double doffs_px = file.number("doffs", -kLargestOffset, kLargestOffset);
    if (file.has("cam1") && std::abs(doffs_px - result.stereo.doffs_px) > kLargestContradiction_px)
      file.fail("doffs", "cx of cam1 minus cx of cam0");
    result.stereo.doffs_px = doffs_px;
  }
  if (file.has("width")) result.stereo.width = file.number("width", 1, kLargestSize);
  if (file.has("height")) result.stereo.height = file.number("height", 1, kLargestSize);
  if (file.has("ndisp")) result.stereo.num_disparities = file.number("ndisp", 1, kLargestSize);
  if (file.has("isint")) result.integer_disparities = file.number("isint", 0, 1) == 1;
  result.vmin = optionalNumber(file, "vmin", -kLargestSize, kLargestSize);
  result.vmax = optionalNumber(file, "vmax", -kLargestSize, kLargestSize);
  result.dyavg = optionalNumber(file, "dyavg", 0.0, kLargestOffset);
  result.dymax = optionalNumber(file, "dymax", 0.0, kLargestOffset);
  if (!file.has("doffs")) file.require("cam1");  // else nobody knows what infinity is
  if (file.has("width")) file.require("height");
  if (file.has("height")) file.require("width");
  return result;
}

std::string encodeMiddleburyCalibration(const StereoCalibration& calibration) {
  calibration.validate();
  const auto camera = [&](double cx_px) {
    const std::string focal = numberText(calibration.focal_px);
    return focal + " 0 " + numberText(cx_px) + "; 0 " + focal + " " + numberText(calibration.cy_px) +
           "; 0 0 1]\n";
  };
  std::string file = "cam0=[" + camera(calibration.cx_px) + "cam1=[" +
                     camera(calibration.cx_px + calibration.doffs_px) +
                     "doffs=" + numberText(calibration.doffs_px) +
                     "\nbaseline=" + numberText(1000 * calibration.baseline_m) + "\n";
  if (calibration.width > 0) file += "width=" + std::to_string(calibration.width) + "\n";
  if (calibration.height > 0) file += "height=" + std::to_string(calibration.height) + "\n";
  if (calibration.num_disparities > 0) file += "ndisp=" + std::to_string(calibration.num_disparities) + "\n";
  return file;
}

}  // namespace pomona
