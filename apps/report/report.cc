#include "apps/report/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "apps/report/page.h"
#include "apps/views.h"
#include "baselines/method.h"

namespace pomona {
namespace {

using Json = nlohmann::ordered_json;

constexpr float kStepsPerPx = 16;
constexpr float kErrorLimit_px = 4;
constexpr int kPaletteSize = 256;

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? std::uint32_t{bytes[k]} : 0; };
    const std::uint32_t triple = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[triple >> shift & 63];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  return text.replace(text.size() - padding, padding, padding, '=');
}

std::string encodeLeft(const cv::Mat& left, int factor) {
  cv::Mat image = toBgr8(left);
  const cv::Size size((image.cols + factor - 1) / factor, (image.rows + factor - 1) / factor);
  if (factor > 1) cv::resize(image, image, size, 0, 0, cv::INTER_AREA);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
  return base64(bytes);
}

// See HtmlReport for the format.
std::string encodeMap(const cv::Mat& disparity, float low, int factor) {
  constexpr float kLargestCode = 65535;
  const int width = (disparity.cols + factor - 1) / factor, height = (disparity.rows + factor - 1) / factor;
  cv::Mat planes(2 * height, width, CV_8U);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float d = disparity.at<float>(y * factor, x * factor);
      const float code =
          std::isfinite(d) ? std::clamp(1 + std::round((d - low) * kStepsPerPx), 1.0f, kLargestCode) : 0;
      planes.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(static_cast<int>(code) >> 8);
      planes.at<std::uint8_t>(y + height, x) = static_cast<std::uint8_t>(static_cast<int>(code) & 255);
    }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", planes, bytes,
               {cv::IMWRITE_PNG_COMPRESSION, 9, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT});
  return base64(bytes);
}

Json hexColors(const cv::Mat& row) {
  Json colors = Json::array();
  for (int i = 0; i < row.cols; ++i) {
    const cv::Vec3b c = row.at<cv::Vec3b>(0, i);
    std::array<char, 8> hex;
    std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", c[2], c[1], c[0]);
    colors.push_back(hex.data());
  }
  return colors;
}

// The colours of the pictures that `pomona compute` writes, cold to warm and good to bad.
Json palettes() {
  cv::Mat ramp(1, kPaletteSize, CV_32F);
  for (int i = 0; i < kPaletteSize; ++i) ramp.at<float>(0, i) = static_cast<float>(i) / (kPaletteSize - 1);
  const cv::Mat nothing(1, kPaletteSize, CV_32F, cv::Scalar(0));
  return {{"disparity", hexColors(colorizeDisparity(ramp, {0, 1}))},
          {"error", hexColors(colorizeError(ramp, nothing, 1))}};
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return list;
}

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

Json curvePoints(const std::optional<RegionFigures>& figures) {
  Json points = Json::array();
  if (figures)
    for (const CoverageCurve::Point& point : figures->curve.points)
      points.push_back(
          {rounded(point.coverage_percent), rounded(point.wrong_percent), rounded(point.oracle_percent)});
  return points;
}

Json subpixelBins(const std::optional<RegionFigures>& figures) {
  Json bins = Json::array();
  if (figures)
    for (const SubpixelErrors::Bin& bin : figures->subpixel.bins)
      bins.push_back({rounded(bin.biasPx()), rounded(bin.rmsPx())});  // null for the NaN of an empty bin
  return bins;
}

Json figuresByRegion(const auto& figures) {
  return {{name(Region::kAll), numbers(figures(Region::kAll))},
          {name(Region::kNonoccluded), numbers(figures(Region::kNonoccluded))}};
}

Json figuresOfScene(const std::string& scene, const EvalRecord& record) {
  Json methods = Json::object();
  for (const Measurement& m : record.measurements) {
    if (m.scene != scene) continue;
    methods[m.method] = figuresByRegion([&](Region region) { return figuresOf(m, region); });
    methods[m.method]["curves"] = {{name(Region::kAll), curvePoints(m.all)},
                                   {name(Region::kNonoccluded), curvePoints(m.nonoccluded)}};
    methods[m.method]["subpixel"] = {{name(Region::kAll), subpixelBins(m.all)},
                                     {name(Region::kNonoccluded), subpixelBins(m.nonoccluded)}};
  }
  return methods;
}

// What is common to all scenes.
Json generalPart(const EvalRecord& record) {
  Json root = {{"region", name(record.region)}, {"methods", record.methods}, {"peers", Json::array()},
               {"presets", Json::array()},      {"columns", Json::array()},  {"facts", Json::array()},
               {"problems", record.problems},   {"remarks", record.remarks}, {"palettes", palettes()},
               {"errorLimit", kErrorLimit_px}};
  for (const std::string& method : record.methods)
    if (method.starts_with("opencv")) root["peers"].push_back(method);
  for (const MethodInfo& preset : presetMethods())
    if (std::find(record.methods.begin(), record.methods.end(), preset.name) != record.methods.end())
      root["presets"].push_back(preset.name);
  for (const FigureColumn& column : figureColumns())
    root["columns"].push_back({{"name", column.name},
                               {"description", column.description},
                               {"decimals", column.decimals},
                               {"main", column.in_terminal}});
  for (const EvalRecord::Fact& fact : record.facts)
    root["facts"].push_back({{"name", fact.name}, {"value", fact.value}});
  for (const std::string& method : record.methods) {
    Json& mean = root["means"][method];
    mean = figuresByRegion([&](Region region) { return record.meanOfMethod(method, region); });
    for (const Region region : {Region::kAll, Region::kNonoccluded})
      mean["scenes"][name(region)] = record.scenesBehindMean(method, region);
  }
  return root;
}

// As the content of a <script> element, where "</script>" and "<!--" would be understood as HTML.
std::string inScript(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

// `page` with each {{name}} replaced.
std::string filled(std::string_view page, const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string text;
  while (!page.empty()) {
    const std::size_t open = page.find("{{"), close = page.find("}}", open);
    text += page.substr(0, open);
    if (open == page.npos) break;
    const std::string_view name = page.substr(open + 2, close - open - 2);
    for (const auto& [part, content] : parts)
      if (part == name) text += content;
    page.remove_prefix(close + 2);
  }
  return text;
}

}  // namespace

void HtmlReport::addScene(const std::string& name, const Scene& scene, int num_disparities) {
  SceneEntry entry;
  entry.name = name;
  entry.width = scene.left.cols;
  entry.height = scene.left.rows;
  entry.num_disparities = num_disparities;
  entry.factor = (entry.width + kWidest - 1) / kWidest;
  entry.low = -1;  // sub-pixel steps may lead a little below the range searched
  entry.colors = scene.ground_truth.empty() ? DisparityRange{0, static_cast<float>(num_disparities)}
                                            : typicalRange(scene.ground_truth);
  entry.left = encodeLeft(scene.left, entry.factor);
  if (!scene.ground_truth.empty()) entry.truth = encodeMap(scene.ground_truth, entry.low, entry.factor);
  scenes_.push_back(std::move(entry));
}

void HtmlReport::addMap(const std::string& method, const cv::Mat& disparity) {
  SceneEntry& scene = scenes_.back();
  scene.maps.emplace_back(method, encodeMap(disparity, scene.low, scene.factor));
}

std::string HtmlReport::html(const EvalRecord& record) const {
  Json root = generalPart(record);
  root["scenes"] = Json::array();
  std::string data;
  for (const SceneEntry& scene : scenes_) {
    if (scene.maps.empty()) continue;
    data += "<script type=\"application/json\" id=\"data-" + std::to_string(root["scenes"].size()) + "\">";
    data +=
        inScript({{"left", scene.left},
                  {"truth", scene.truth.empty() ? Json(nullptr) : Json(scene.truth)},
                  {"maps", Json(std::map<std::string, std::string>(scene.maps.begin(), scene.maps.end()))}});
    data += "</script>\n";
    root["scenes"].push_back({{"name", scene.name},
                              {"width", scene.width},
                              {"height", scene.height},
                              {"disparities", scene.num_disparities},
                              {"stride", scene.factor},
                              {"low", scene.low},
                              {"step", 1 / kStepsPerPx},
                              {"range", {{"low", scene.colors.low}, {"high", scene.colors.high}}},
                              {"methods", figuresOfScene(scene.name, record)}});
  }
  return filled(kPageHtml,
                {{"style", kPageCss}, {"script", kPageJs}, {"record", inScript(root)}, {"scenes", data}});
}

}  // namespace pomona
