#include "bench/accuracy/report.h"

#include <cmath>
#include <iomanip>
#include <opencv2/core/persistence.hpp>
#include <opencv2/core/version.hpp>
#include <sstream>
#include <stdexcept>

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

using Columns = std::vector<Figure>;

std::string number(double value, Figure figure) {
  if (std::isnan(value)) return "-";
  const bool fine = figure == kInlierBias || figure == kInlierRms;
  std::ostringstream out;
  out << std::fixed << std::setprecision(fine ? 3 : 2) << value;
  return out.str();
}

void addRow(std::ostream& out, const std::vector<std::string>& cells) {
  out << "|";
  for (const std::string& cell : cells) out << " " << cell << " |";
  out << "\n";
}

void addHeader(std::ostream& out, const std::vector<std::string>& cells) {
  addRow(out, cells);
  out << "|---|";
  for (std::size_t i = 1; i < cells.size(); ++i) out << "--:|";
  out << "\n";
}

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

// One row per scene, one column per method of the kind; a cell holds several figures over all pixels.
void addScenes(std::ostream& out, const std::vector<MethodFigures>& methods, MapKind kind,
               const Columns& figures) {
  std::vector<std::string> header = {"scene"};
  std::vector<std::vector<std::string>> rows;
  for (const MethodFigures& method : methods) {
    if (method.kind != kind) continue;
    header.push_back(method.method);
    rows.resize(method.scenes.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].empty()) rows[i].push_back(method.scenes[i].scene);
      std::string cell;
      for (const Figure f : figures) cell += (cell.empty() ? "" : " / ") + number(method.scenes[i].all[f], f);
      rows[i].push_back(cell);
    }
  }
  addHeader(out, header);
  for (const auto& row : rows) addRow(out, row);
}

std::string jsonOf(const Figures& figures) {
  std::string text;
  for (int i = 0; i < kFigures; ++i)
    if (!std::isnan(figures[i]))
      text += (text.empty() ? "\"" : ", \"") + std::string(kFigureNames[i]) +
              "\": " + number(figures[i], static_cast<Figure>(i));
  return "{" + text + "}";
}

std::string jsonOf(const SceneFigures& scene) {
  return "    \"" + scene.scene + "\": {\"all\": " + jsonOf(scene.all) +
         ", \"nonoccluded\": " + jsonOf(scene.nonoccluded) + "}";
}

Figures figuresFrom(const cv::FileNode& node) {
  Figures figures = noFigures();
  for (std::size_t i = 0; i < kFigures; ++i)
    if (const cv::FileNode figure = node[kFigureNames[i]]; !figure.isNone()) figures[i] = figure.real();
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
  std::string scenes, body;
  if (!methods.empty())
    for (const SceneFigures& scene : methods.front().scenes)
      scenes += (scenes.empty() ? "\"" : ", \"") + scene.scene + "\"";
  for (const MethodFigures& method : methods) {
    body += (body.empty() ? "  \"" : ",\n  \"") + method.method + "\": {\n" + jsonOf(method.mean());
    for (const SceneFigures& scene : method.scenes) body += ",\n" + jsonOf(scene);
    body += "\n  }";
  }
  return "{\n \"scenes\": [" + scenes + "],\n \"methods\": {\n" + body + "\n }\n}\n";
}

std::vector<MethodFigures> readFigures(const std::string& path) {
  std::vector<MethodFigures> methods;
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ | cv::FileStorage::FORMAT_JSON);
    if (!file.isOpened()) throw std::runtime_error("cannot be read");
    for (const cv::FileNode node : file["methods"]) {
      MethodFigures method{node.name(), kindOf(node.name()), {}};
      for (const cv::FileNode name : file["scenes"]) {
        const cv::FileNode scene = node[name.string()];
        method.scenes.push_back(
            {name.string(), figuresFrom(scene["all"]), figuresFrom(scene["nonoccluded"])});
      }
      methods.push_back(method);
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return methods;
}

}  // namespace pomona
