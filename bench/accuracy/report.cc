#include "bench/accuracy/report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <sstream>
#include <stdexcept>

#include "bench/accuracy/table.h"
#include "datasets/input_file.h"

namespace pomona {
namespace {

constexpr const char* kIntroduction = R"(# Accuracy

Written by `pomona_accuracy`; CONTRIBUTING.md says how. Pomona's presets; local window methods (SSD and NCC with 9x9
windows, adaptive support weights with 35x35) with the same checks and hole filling as the presets; and OpenCV )" CV_VERSION
                                      R"(:
StereoBM with 9x9 windows, StereoSGBM in its modes (blockSize 3, P1 72, P2 288, disp12MaxDiff 1, uniquenessRatio 10,
speckles 100/2, preFilterCap 63), and MODE_HH with ximgproc's weighted least squares filter (lambda 8000, sigma 1.5).
OpenCV's get gray views padded so that the full width is matched; for dense maps their holes are filled row by row from
the background. All search the same disparities: 0 to the largest true one plus 4, rounded up to a multiple of 16.

A: all pixels with known truth; N: those of them that both cameras see. bad-t: percent that is off by more than t px
or has no disparity; wrong-t: percent of those with a disparity that is off by more than t px; avg, rms: mean and root
mean square error of those with a disparity, px; A99: their 99 % quantile, px; coverage: percent with a disparity;
excess-area: what the confidence loses to a perfect one (area between the coverage curve for errors above 1 px and the
oracle's, percent); inlier-rms: root mean square of errors up to 1 px. Each scene counts the same.
)";

using Json = nlohmann::ordered_json;
using Columns = std::vector<Figure>;

// One row per method of the kind, the columns once over all pixels (A) and once over the non-occluded ones
// (N).
void addMeans(std::ostream& out, const std::vector<MethodFigures>& methods, MapKind kind,
              const Columns& columns) {
  std::vector<std::string> header = {"method"};
  for (const char* region : {"A ", "N "})
    for (const Figure column : columns) header.push_back(std::string(region) + kFigureNames[column]);
  addHeader(out, header);
  for (const MethodFigures& method : methods) {
    if (method.kind != kind) continue;
    const SceneFigures mean = method.mean();
    std::vector<std::string> cells = {method.method};
    for (const Figures* figures : {&mean.all, &mean.nonoccluded})
      for (const Figure column : columns) cells.push_back(number((*figures)[column], column));
    addRow(out, cells);
  }
}

// One row per scene of the first method, one column per method of the kind; a cell holds several figures over
// all pixels.
void addScenes(std::ostream& out, const std::vector<MethodFigures>& methods, MapKind kind,
               const Columns& figures) {
  std::vector<std::string> header = {"scene"};
  for (const MethodFigures& method : methods)
    if (method.kind == kind) header.push_back(method.method);
  addHeader(out, header);
  if (methods.empty()) return;
  for (const SceneFigures& row : methods.front().scenes) {
    std::vector<std::string> cells = {row.scene};
    for (const MethodFigures& method : methods) {
      if (method.kind != kind) continue;
      std::string cell;
      for (const SceneFigures& scene : method.scenes)
        if (scene.scene == row.scene)
          for (const Figure f : figures) cell += (cell.empty() ? "" : " / ") + number(scene.all[f], f);
      cells.push_back(cell.empty() ? "-" : cell);
    }
    addRow(out, cells);
  }
}

// To a millionth: what is kept can be averaged again without a trace in the tables.
Json jsonOf(const Figures& figures) {
  constexpr double kSteps = 1e6;
  Json json = Json::object();
  for (std::size_t i = 0; i < kFigures; ++i)
    if (!std::isnan(figures[i])) json[kFigureNames[i]] = std::round(figures[i] * kSteps) / kSteps;
  return json;
}

// `"name": value` in one line, so that a change of one scene is a change of one line.
std::string lineOf(const SceneFigures& scene) {
  const Json figures = {{"all", jsonOf(scene.all)}, {"nonoccluded", jsonOf(scene.nonoccluded)}};
  return "    " + Json(scene.scene).dump() + ": " + figures.dump();
}

Figures figuresFrom(const Json& json) {
  Figures figures = noFigures();
  for (std::size_t i = 0; i < kFigures; ++i) figures[i] = json.value(kFigureNames[i], figures[i]);
  return figures;
}

MapKind kindOf(const std::string& method) {
  for (const MapKind kind : {MapKind::kDense, MapKind::kSparse, MapKind::kRaw})
    if (method.ends_with(std::string(" ") + kMapKindNames[static_cast<int>(kind)])) return kind;
  throw std::runtime_error("\"" + method + "\" ends in no kind of map");
}

}  // namespace

std::string markdown(const std::vector<MethodFigures>& methods) {
  std::ostringstream out;
  out << kIntroduction << "\n## Dense maps: mean over the scenes\n\n";
  addMeans(out, methods, MapKind::kDense,
           {kBad05, kBad1, kBad2, kBad4, kAverageError, kRmsError, kErrorQuantile99});
  out << "\n## Sparse maps: mean over the scenes\n\n";
  addMeans(out, methods, MapKind::kSparse, {kCoverage, kWrong05, kWrong1, kWrong2, kExcessArea, kInlierRms});
  out << "\n## Raw winners of the window methods: mean over the scenes\n\n";
  addMeans(out, methods, MapKind::kRaw, {kBad05, kBad1, kBad2, kBad4, kAverageError});
  out << "\n## Dense maps by scene: A bad-1 / bad-2 / avg\n\n";
  addScenes(out, methods, MapKind::kDense, {kBad1, kBad2, kAverageError});
  out << "\n## Sparse maps by scene: A coverage / wrong-1 / wrong-2\n\n";
  addScenes(out, methods, MapKind::kSparse, {kCoverage, kWrong1, kWrong2});
  return out.str();
}

std::string json(const std::vector<MethodFigures>& methods) {
  Json scenes = Json::array();
  if (!methods.empty())
    for (const SceneFigures& scene : methods.front().scenes) scenes.push_back(scene.scene);
  std::string body;
  for (const MethodFigures& method : methods) {
    body += (body.empty() ? "  " : ",\n  ") + Json(method.method).dump() + ": {\n" + lineOf(method.mean());
    for (const SceneFigures& scene : method.scenes) body += ",\n" + lineOf(scene);
    body += "\n  }";
  }
  return "{\n \"scenes\": " + scenes.dump() + ",\n \"methods\": {\n" + body + "\n }\n}\n";
}

std::vector<MethodFigures> readFigures(const std::string& path) {
  const std::string text = readFile(path);
  std::vector<MethodFigures> methods;
  try {
    const Json root = Json::parse(text);
    for (const auto& [name, scenes] : root.at("methods").items()) {
      MethodFigures method{name, kindOf(name), {}};
      for (const auto& [scene, figures] : scenes.items())
        if (scene != "mean")
          method.scenes.push_back(
              {scene, figuresFrom(figures.at("all")), figuresFrom(figures.at("nonoccluded"))});
      methods.push_back(std::move(method));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return methods;
}

}  // namespace pomona
