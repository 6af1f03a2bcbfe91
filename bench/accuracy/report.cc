#include "bench/accuracy/report.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <opencv2/core/persistence.hpp>
#include <opencv2/core/version.hpp>
#include <sstream>
#include <stdexcept>

namespace pomona {
namespace {

constexpr const char* kIntroduction = R"(# Accuracy

Written by `pomona_accuracy`; CONTRIBUTING.md says how. Every preset, and as the peer OpenCV )" CV_VERSION
                                      R"( StereoSGBM
MODE_HH: blockSize 3, P1 72, P2 288, disp12MaxDiff 1, uniquenessRatio 10, speckles 100/2, preFilterCap 63, on gray
views padded so that the full width is matched; for dense maps its holes are filled row by row from the background.
All search the same disparities: 0 to the largest true one plus 4, rounded up to a multiple of 16.

A: all pixels with known truth; N: those of them that both cameras see. bad-t: percent that is off by more than t px
or has no disparity; wrong-t: percent of those with a disparity that is off by more than t px; avg: mean error of
those with a disparity, px; coverage: percent with a disparity. Each scene counts the same.
)";

using Columns = std::vector<Figure>;

std::string number(double value) {
  if (std::isnan(value)) return "-";
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << value;
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
void addMeans(std::ostream& out, const std::vector<MethodFigures>& methods, bool dense,
              const Columns& columns) {
  std::vector<std::string> header = {"method"};
  for (const char* region : {"A ", "N "})
    for (const Figure column : columns) header.push_back(std::string(region) + kFigureNames[column]);
  addHeader(out, header);
  for (const MethodFigures& method : methods) {
    if (method.dense != dense) continue;
    const SceneFigures mean = method.mean();
    std::vector<std::string> cells = {method.method};
    for (const Figures* figures : {&mean.all, &mean.nonoccluded})
      for (const Figure column : columns) cells.push_back(number((*figures)[column]));
    addRow(out, cells);
  }
}

// One row per scene, one column per method of the kind; a cell holds several figures over all pixels.
void addScenes(std::ostream& out, const std::vector<MethodFigures>& methods, bool dense,
               const Columns& figures) {
  std::vector<std::string> header = {"scene"};
  std::vector<std::vector<std::string>> rows;
  for (const MethodFigures& method : methods) {
    if (method.dense != dense) continue;
    header.push_back(method.method);
    rows.resize(method.scenes.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].empty()) rows[i].push_back(method.scenes[i].scene);
      std::string cell;
      for (const Figure f : figures) cell += (cell.empty() ? "" : " / ") + number(method.scenes[i].all[f]);
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
      text += (text.empty() ? "\"" : ", \"") + std::string(kFigureNames[i]) + "\": " + number(figures[i]);
  return "{" + text + "}";
}

std::string jsonOf(const SceneFigures& scene) {
  return "    \"" + scene.scene + "\": {\"all\": " + jsonOf(scene.all) +
         ", \"nonoccluded\": " + jsonOf(scene.nonoccluded) + "}";
}

}  // namespace

std::string markdown(const std::vector<MethodFigures>& methods) {
  std::ostringstream out;
  out << kIntroduction << "\n## Dense maps: mean over the scenes\n\n";
  addMeans(out, methods, true, {kBad05, kBad1, kBad2, kBad4, kAverageError});
  out << "\n## Sparse maps: mean over the scenes\n\n";
  addMeans(out, methods, false, {kCoverage, kWrong05, kWrong1, kWrong2});
  out << "\n## Dense maps by scene: A bad-1 / bad-2 / avg\n\n";
  addScenes(out, methods, true, {kBad1, kBad2, kAverageError});
  out << "\n## Sparse maps by scene: A coverage / wrong-1 / wrong-2\n\n";
  addScenes(out, methods, false, {kCoverage, kWrong1, kWrong2});
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

AcceptedFigures readAccepted(const std::string& path) {
  AcceptedFigures accepted;
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ | cv::FileStorage::FORMAT_JSON);
    if (!file.isOpened()) throw std::runtime_error("cannot be read");
    for (const cv::FileNode scene : file["scenes"]) accepted.scenes.push_back(scene.string());
    for (const cv::FileNode method : file["methods"]) {
      Figures& mean = accepted.mean[method.name()];
      for (int i = 0; i < kFigures; ++i) {
        const cv::FileNode figure = method["mean"]["all"][kFigureNames[i]];
        mean[i] = figure.isNone() ? std::numeric_limits<double>::quiet_NaN() : figure.real();
      }
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return accepted;
}

}  // namespace pomona
