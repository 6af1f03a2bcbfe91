#include "apps/sparse_files.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "apps/views.h"
#include "camera/cloud_file.h"

namespace pomona {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kJsonIndent = 2;

std::string quotedField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

/// Values with a comma before each, in as few digits as tell the float.
void appendFields(std::ostringstream& line, std::initializer_list<float> values) {
  for (const float value : values) {
    line << ',';
    if (std::isfinite(value)) line << value;
  }
}

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <typename Point>
Json pointOrNull(const Point& p) {
  return std::isfinite(p.z) ? Json{p.x, p.y, p.z} : Json(nullptr);
}

Json jsonOf(const SparseObject& object) {
  Json outline = Json::array();
  for (const cv::Point2f corner : object.outline_px) outline.push_back({corner.x, corner.y});
  Json json{{"label", object.label}, {"found", object.found()}};
  if (!object.found()) json["why_not"] = object.why_not;
  const cv::Rect2f& box = object.box_px;
  json["outline_px"] = outline;
  json["box_px"] = box.empty() ? Json(nullptr) : Json{box.x, box.y, box.width, box.height};
  json["point_m"] = pointOrNull(object.point_m);
  json["distance_m"] = numberOrNull(object.distance_m);
  json["sigma_m"] = numberOrNull(object.sigma_m);
  json["bearing_deg"] = numberOrNull(object.bearing_deg);
  json["support"] = object.support;
  return json;
}

Json jsonOf(const SparsePoint& point) {
  return {{"object", point.object < 0 ? Json(nullptr) : Json(point.object)},
          {"left_px", {point.left_px.x, point.left_px.y}},
          {"right_px", {point.right_px.x, point.right_px.y}},
          {"disparity_px", numberOrNull(point.disparity_px)},
          {"sigma_px", numberOrNull(point.sigma_px)},
          {"point_m", pointOrNull(point.point_m)},
          {"sigma_z_m", numberOrNull(point.sigma_z_m)}};
}

}  // namespace

std::string encodeCsv(const SparseResult& result) {
  std::ostringstream lines;
  lines.imbue(std::locale::classic());
  lines.precision(std::numeric_limits<float>::max_digits10);
  lines << "object,left_x_px,left_y_px,right_x_px,right_y_px,disparity_px,sigma_px,x_m,y_m,z_m,sigma_z_m\n";
  for (const SparsePoint& p : result.points) {
    if (p.object >= 0) lines << quotedField(result.objects[p.object].label);
    appendFields(lines, {p.left_px.x, p.left_px.y, p.right_px.x, p.right_px.y, p.disparity_px, p.sigma_px,
                         p.point_m.x, p.point_m.y, p.point_m.z, p.sigma_z_m});
    lines << '\n';
  }
  return lines.str();
}

std::string encodePly(const SparseResult& result, const cv::Mat& left) {
  const cv::Mat colors = toBgr8(left);
  std::vector<CloudPoint> cloud;
  for (const SparsePoint& p : result.points) {
    if (!std::isfinite(p.point_m.z)) continue;
    const cv::Point pixel(std::clamp(cvRound(p.left_px.x), 0, colors.cols - 1),
                          std::clamp(cvRound(p.left_px.y), 0, colors.rows - 1));
    cloud.push_back({p.point_m, colors.at<cv::Vec3b>(pixel)});
  }
  return encodePlyPoints(cloud);
}

std::string encodeJson(const SparseResult& result, const std::string& plugin,
                       const PluginSettings& settings) {
  Json json{{"plugin", plugin}};
  for (const auto& [name, value] : settings.values()) json["settings"][name] = value;
  for (const SparseFigure& figure : result.figures)
    json["figures"].push_back(
        {{"name", figure.name}, {"value", numberOrNull(figure.value)}, {"unit", figure.unit}});
  json["objects"] = Json::array();
  for (const SparseObject& object : result.objects) json["objects"].push_back(jsonOf(object));
  json["points"] = Json::array();
  for (const SparsePoint& point : result.points) json["points"].push_back(jsonOf(point));
  return json.dump(kJsonIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pomona
