#include "datasets/middlebury_calib.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "datasets/input_file.h"

namespace pomona {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

struct Camera {
  double focal_px, cx_px, cy_px;
};

class CalibrationFile {
 public:
  explicit CalibrationFile(const std::string& path) : path_(path), text_(readFile(path)) {
    int line = 1;
    for (std::string_view rest = text_; !rest.empty(); ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      addLine(line, trimmed(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    last_line_ = std::max(1, line - 1);
  }

  bool has(std::string_view key) const { return entries_.contains(key); }

  void require(std::string_view key) const {
    if (!has(key)) failAtLine(path_, last_line_, "the file ends without '" + std::string(key) + "='");
  }

  template <typename Number>
  Number number(std::string_view key, Number smallest, Number largest) const {
    Number value{};
    const std::string_view text = entries_.find(key)->second.text;
    if (!parseNumber(text, value) || !(value >= smallest && value <= largest))
      fail(key, "a number from " + shown(smallest) + " to " + shown(largest));
    return value;
  }

  template <typename Number>
  std::optional<Number> optionalNumber(std::string_view key, Number smallest, Number largest) const {
    return has(key) ? std::optional(number(key, smallest, largest)) : std::nullopt;
  }

  // [f 0 cx; 0 f cy; 0 0 1]
  Camera camera(std::string_view key) const {
    std::array<double, 9> k{};
    const std::string_view text = entries_.find(key)->second.text;
    const bool rectified = parseMatrix(text, k) && k[0] > 0 && k[0] == k[4] && k[1] == 0 && k[3] == 0 &&
                           k[6] == 0 && k[7] == 0 && k[8] == 1;
    if (!rectified) fail(key, "[f 0 cx; 0 f cy; 0 0 1] with f > 0");
    return {k[0], k[2], k[5]};
  }

  [[noreturn]] void fail(std::string_view key, const std::string& allowed) const {
    const Entry& entry = entries_.find(key)->second;
    failAtLine(path_, entry.line, std::string(key) + " is " + quoted(entry.text) + "; allowed: " + allowed);
  }

 private:
  struct Entry {
    int line;
    std::string_view text;
  };

  template <typename Number>
  static std::string shown(Number value) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
  }

  void addLine(int line, std::string_view text) {
    if (text.empty()) return;
    const std::size_t equals = text.find('=');
    if (equals == text.npos) failAtLine(path_, line, "expected 'key=value', found " + quoted(text));
    const std::string_view key = trimmed(text.substr(0, equals));
    const Entry entry{line, trimmed(text.substr(equals + 1))};
    if (!entries_.emplace(key, entry).second) failAtLine(path_, line, "a second value for " + quoted(key));
  }

  static bool parseMatrix(std::string_view text, std::array<double, 9>& values) {
    if (!text.starts_with('[') || !text.ends_with(']')) return false;
    text = text.substr(1, text.size() - 2);
    constexpr std::string_view kSeparators = " \t;,";
    std::size_t count = 0;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(kSeparators, begin)) != text.npos; ++count) {
      const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
      if (count == values.size() || !parseNumber(text.substr(begin, end - begin), values[count]) ||
          !std::isfinite(values[count]))
        return false;
      begin = end;
    }
    return count == values.size();
  }

  const std::string& path_;
  std::string text_;
  std::map<std::string_view, Entry> entries_;
  int last_line_ = 1;
};

}  // namespace

MiddleburyCalibration readMiddleburyCalibration(const std::string& path) {
  constexpr int kLargestSize = 1 << 20;
  constexpr double kLargestOffset = 1 << 20;
  constexpr double kSmallestBaseline_mm = 1e-3, kLargestBaseline_mm = 1e9, kMmPerM = 1000;
  const CalibrationFile file(path);
  file.require("cam0");
  file.require("baseline");

  MiddleburyCalibration result;
  const Camera left = file.camera("cam0");
  result.stereo.focal_px = left.focal_px;
  result.stereo.cx_px = left.cx_px;
  result.stereo.cy_px = left.cy_px;
  result.stereo.baseline_m = file.number("baseline", kSmallestBaseline_mm, kLargestBaseline_mm) / kMmPerM;
  if (file.has("cam1")) {
    const Camera right = file.camera("cam1");
    if (std::abs(right.focal_px - left.focal_px) > 1e-3 * left.focal_px)
      file.fail("cam1", "the focal length of cam0, for a rectified pair");
    result.stereo.doffs_px = right.cx_px - left.cx_px;
  }
  if (file.has("doffs")) result.stereo.doffs_px = file.number("doffs", -kLargestOffset, kLargestOffset);
  if (file.has("width")) result.stereo.width = file.number("width", 1, kLargestSize);
  if (file.has("height")) result.stereo.height = file.number("height", 1, kLargestSize);
  if (file.has("ndisp")) result.stereo.num_disparities = file.number("ndisp", 1, kLargestSize);
  if (file.has("isint")) result.integer_disparities = file.number("isint", 0, 1) == 1;
  result.vmin = file.optionalNumber("vmin", -kLargestSize, kLargestSize);
  result.vmax = file.optionalNumber("vmax", -kLargestSize, kLargestSize);
  result.dyavg = file.optionalNumber("dyavg", 0.0, kLargestOffset);
  result.dymax = file.optionalNumber("dymax", 0.0, kLargestOffset);
  return result;
}

std::string encodeMiddleburyCalibration(const StereoCalibration& calibration) {
  calibration.validate();
  const auto text = [](double value) {
    std::array<char, 32> digits{};  // the shortest decimal that reads back as the same number
    return std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  };
  const auto camera = [&](double cx_px) {
    const std::string focal = text(calibration.focal_px);
    return focal + " 0 " + text(cx_px) + "; 0 " + focal + " " + text(calibration.cy_px) + "; 0 0 1]\n";
  };
  std::string file =
      "cam0=[" + camera(calibration.cx_px) + "cam1=[" + camera(calibration.cx_px + calibration.doffs_px) +
      "doffs=" + text(calibration.doffs_px) + "\nbaseline=" + text(1000 * calibration.baseline_m) + "\n";
  if (calibration.width > 0) file += "width=" + std::to_string(calibration.width) + "\n";
  if (calibration.height > 0) file += "height=" + std::to_string(calibration.height) + "\n";
  if (calibration.num_disparities > 0) file += "ndisp=" + std::to_string(calibration.num_disparities) + "\n";
  return file;
}

}  // namespace pomona
