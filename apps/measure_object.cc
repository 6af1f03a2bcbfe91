// `pomona measure`: how far away is what the given regions show?
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/compute_files.h"
#include "apps/muted_stream.h"
#include "apps/print.h"
#include "apps/search_range.h"
#include "apps/verbs.h"
#include "datasets/input_file.h"
#include "datasets/scene_parts.h"
#include "pomona/engine.h"
#include "pomona/measure.h"

namespace pomona {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::vector<double>;

struct MeasureArguments {
  ComputePaths paths;
  std::vector<std::string> boxes, circles, polygons, masks, points;
  std::string radius, shape = "sphere", preset = "balanced";
  int min_disparity = 0;
  std::optional<int> max_disparity;
  int threads = 0;
  bool json = false;
};

/// What was asked for, as it was written.
struct Request {
  std::string text;
  Region region;
};

// "x,y,...": `count` numbers, or for 0 an even number of them.
Numbers numbersOf(const char* option, const std::string& text, std::size_t count, const char* form) {
  Numbers numbers;
  std::istringstream parts(text);
  bool good = !text.empty() && text.back() != ',';
  for (std::string part; good && std::getline(parts, part, ',');)
    good = parseNumber(part, numbers.emplace_back()) && std::isfinite(numbers.back());
  if (!good || (count > 0 ? numbers.size() != count : numbers.size() % 2 != 0))
    throw std::invalid_argument(std::string(option) + " is '" + text + "'; allowed: " + form);
  return numbers;
}

cv::Rect boxOf(const std::string& text) {
  constexpr double kMost = 1e6;
  const Numbers n = numbersOf("--box", text, 4, "X,Y,WIDTH,HEIGHT in pixels");
  for (const double v : n)
    if (std::abs(v) > kMost) throw std::invalid_argument("--box is '" + text + "', out of any image");
  const auto toInt = [](double v) { return static_cast<int>(std::lround(v)); };
  return {toInt(n[0]), toInt(n[1]), toInt(n[2]), toInt(n[3])};
}

std::vector<Request> requestsOf(const MeasureArguments& arguments, cv::Size size) {
  std::vector<Request> requests;
  for (const std::string& text : arguments.boxes) requests.push_back({"box " + text, boxOf(text)});
  for (const std::string& text : arguments.circles) {
    const Numbers n = numbersOf("--circle", text, 3, "X,Y,RADIUS in pixels");
    requests.push_back({"circle " + text, Circle{{n[0], n[1]}, n[2]}});
  }
  for (const std::string& text : arguments.polygons) {
    const Numbers n = numbersOf("--polygon", text, 0, "X,Y,X,Y,... in pixels");
    Polygon corners;
    for (std::size_t i = 0; i < n.size(); i += 2) corners.emplace_back(n[i], n[i + 1]);
    requests.push_back({"polygon " + text, corners});
  }
  const MutedErrorStream muted;
  for (const std::string& path : arguments.masks)
    requests.push_back({"mask " + path, readByteMap(path, size)});
  return requests;
}

MeasureOptions optionsOf(const MeasureArguments& arguments) {
  MeasureOptions options;
  if (arguments.shape == "surface") options.shape = ObjectShape::kSurface;
  if (arguments.radius.empty()) return options;
  if (options.shape == ObjectShape::kSurface)
    throw std::invalid_argument("--radius: --shape is 'surface'; allowed: sphere");
  // What lies outside is in metres, or was not meant for an object within a robot's reach.
  constexpr const char* kForm = "RADIUS,SIGMA in mm, from 1 and 0.01 to 1000, for example 38,6";
  constexpr double kSmallest_mm = 1, kSmallestSigma_mm = 0.01, kLargest_mm = 1000;
  const Numbers n = numbersOf("--radius", arguments.radius, 2, kForm);
  if (n[0] < kSmallest_mm || n[1] < kSmallestSigma_mm || std::max(n[0], n[1]) > kLargest_mm)
    throw std::invalid_argument("--radius is '" + arguments.radius + "'; allowed: " + kForm);
  options.radius_m = n[0] / 1000;
  options.radius_sigma_m = n[1] / 1000;
  return options;
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

Json listOf(const cv::Vec3d& v) {
  return {v[0], v[1], v[2]};
}

// A wrong radius shows as disparities that do not agree: on none of that size.
std::string reasonOf(const ObjectMeasurement& m, const MeasureOptions& options) {
  const std::string reason(explain(m.failure));
  if (m.failure != MeasureFailure::kScattered || options.radius_m == 0) return reason;
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(), ", a sphere's of radius %g +- %g mm", 1000 * options.radius_m,
                1000 * options.radius_sigma_m);
  return reason + text.data();
}

Json jsonOf(const std::string& name, const ObjectMeasurement& m, const MeasureOptions& options) {
  if (!m.ok()) return {{"region", name}, {"measured", false}, {"reason", reasonOf(m, options)}};
  Json entry{{"region", name},
             {"measured", true},
             {"distance_m", m.distance_m},
             {"distance_sigma_m", m.distance_sigma_m},
             {"near_point_m", listOf(m.near_point_m)},
             {"azimuth_rad", m.azimuth_rad},
             {"elevation_rad", m.elevation_rad}};
  if (!std::isnan(m.radius_m)) {
    entry["center_distance_m"] = m.center_distance_m;
    entry["center_sigma_m"] = m.center_sigma_m;
    entry["center_m"] = listOf(m.center_m);
    entry["radius_m"] = m.radius_m;
    entry["radius_sigma_m"] = m.radius_sigma_m;
  }
  entry["support_px"] = m.support_px;
  entry["support_share"] = m.support_share;
  return entry;
}

Json jsonOf(const std::string& name, const PointMeasurement& m) {
  if (!m.ok())
    return {{"region", name},
            {"measured", false},
            {"reason", explain(m.failure)},
            {"state", pomona::name(m.state)}};
  return {{"region", name},
          {"measured", true},
          {"distance_m", m.distance_m},
          {"distance_sigma_m", m.distance_sigma_m},
          {"near_point_m", listOf(m.point_m)},
          {"state", pomona::name(m.state)}};
}

// "box 1,2,3,4: 0.6512 +- 0.0006 m, at (...), ..."
std::string lineOf(const Json& entry) {
  const std::string name = entry["region"].get<std::string>() + ": ";
  if (!entry["measured"]) return name + "not measured: " + entry["reason"].get<std::string>();
  const auto number = [&](const char* key) { return entry[key].get<double>(); };
  std::array<char, 160> text;
  const Json& point = entry["near_point_m"];
  std::snprintf(text.data(), text.size(), "%.4f +- %.4f m, at (%.4f, %.4f, %.4f) m", number("distance_m"),
                number("distance_sigma_m"), point[0].get<double>(), point[1].get<double>(),
                point[2].get<double>());
  std::string line = name + text.data();
  if (entry.contains("center_m")) {
    std::snprintf(text.data(), text.size(), ", centre %.4f +- %.4f m, radius %.4f +- %.4f m",
                  number("center_distance_m"), number("center_sigma_m"), number("radius_m"),
                  number("radius_sigma_m"));
    line += text.data();
  }
  if (entry.contains("azimuth_rad")) {
    line += ", " + angleText(degrees(number("azimuth_rad")), "right", "left") + ", " +
            angleText(degrees(number("elevation_rad")), "up", "down") + ", " +
            std::to_string(entry["support_px"].get<int>()) + " px";
  } else {
    line += ", " + entry["state"].get<std::string>();
  }
  return line;
}

// What makes all measurements of a pair doubtful; not among them, lest it break the JSON.
void warnOfRows(const StereoResult& result) {
  std::array<char, 160> text;
  if (std::isnan(result.row_offset_px)) {
    std::cerr
        << "pomona: warning: whether the views' rows match is unknown: where they are off, or the views "
           "exchanged, nothing can be measured; see pomona check\n";
  } else if (result.rowsAreOff()) {
    std::snprintf(text.data(), text.size(), "the right view is %+.2f rows off, %.2f where it is worst%s",
                  result.row_offset_px, result.row_error_px, result.rows_aligned ? "; it was moved" : "");
    std::cerr << "pomona: warning: " << text.data()
              << ": the cameras want a new calibration; see pomona check\n";
  }
}

void measure(const MeasureArguments& arguments) {
  if (arguments.paths.calibration.empty() && arguments.paths.rig.empty())
    throw CLI::RequiresError("measure", "--calib or --rig");
  const MeasureOptions measure_options = optionsOf(arguments);
  const ComputeInputs inputs = readInputs(arguments.paths);
  const std::vector<Request> requests = requestsOf(arguments, inputs.left.size());
  std::vector<Numbers> points;
  for (const std::string& text : arguments.points)
    points.push_back(numbersOf("--point", text, 2, "X,Y in pixels"));
  if (requests.empty() && points.empty())
    throw CLI::RequiresError("measure", "--box, --circle, --polygon, --mask or --point");

  Options options = Options::preset(arguments.preset);
  options.threads = arguments.threads;
  const SearchRange range =
      searchRange(arguments.paths, inputs, arguments.min_disparity, arguments.max_disparity, options);
  options.min_disparity = range.min;
  options.num_disparities = range.count;
  const StereoResult result = computeDisparity(inputs.left, inputs.right, options);
  warnOfRows(result);

  Json entries = Json::array();
  for (const auto& [text, region] : requests)
    entries.push_back(
        jsonOf(text, measureObject(result, *inputs.calibration, region, measure_options), measure_options));
  for (std::size_t i = 0; i < points.size(); ++i)
    entries.push_back(jsonOf("point " + arguments.points[i],
                             measurePoint(result, *inputs.calibration, points[i][0], points[i][1])));
  if (arguments.json)
    std::cout << entries.dump(2) << '\n';
  else
    for (const Json& entry : entries) std::cout << lineOf(entry) << '\n';
  if (std::none_of(entries.begin(), entries.end(),
                   [](const Json& entry) { return entry["measured"].get<bool>(); }))
    throw CLI::RuntimeError(kNegativeVerdict);
}

}  // namespace

void addMeasure(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("measure",
                         "Measure how far away objects are, and how sure that is: exit status 3 if "
                         "none could be measured");
  const auto arguments = std::make_shared<MeasureArguments>();  // lives as long as the callback
  ComputePaths& paths = arguments->paths;
  verb->add_option("left", paths.left, "Left image, which the regions belong to")->required();
  verb->add_option("right", paths.right, "Right image")->required();
  CLI::Option* calibration =
      verb->add_option("--calib", paths.calibration, "Geometry of the rectified pair (see pomona rig)");
  verb->add_option("--rig", paths.rig,
                   "The views are not rectified: rectify them first, by this rig. Regions belong to the "
                   "rectified left view")
      ->excludes(calibration);
  const auto add = [&](const char* option, std::vector<std::string>& texts, const char* description) {
    verb->add_option(option, texts, description)->allow_extra_args(false);
  };
  add("--box", arguments->boxes, "X,Y,WIDTH,HEIGHT of the object; this and the next four may be given often");
  add("--circle", arguments->circles, "X,Y,RADIUS");
  add("--polygon", arguments->polygons, "X,Y,X,Y,X,Y,...: its corners");
  add("--mask", arguments->masks, "8-bit gray image, not 0 on the object");
  add("--point", arguments->points, "X,Y: a single pixel");
  verb->add_option("--radius", arguments->radius, "RADIUS,SIGMA to expect of spheres, in mm, e.g. 38,6");
  verb->add_option("--shape", arguments->shape, "sphere (default), or surface: anything")
      ->check(CLI::IsMember({"sphere", "surface"}));
  verb->add_flag("--json", arguments->json, "Print JSON");
  verb->add_option("--min-disparity", arguments->min_disparity, "Smallest disparity searched (default 0)");
  verb->add_option("--max-disparity", arguments->max_disparity,
                   "Search below this (default: the calibration's ndisp, else estimated)");
  verb->add_option("--preset", arguments->preset, "fast, balanced (default), quality or paper");
  verb->add_option("--threads", arguments->threads, "Worker threads (default 0: one per processor)");
  verb->callback([arguments] { measure(*arguments); });
}

}  // namespace pomona
