// readManifest() of walk.h.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "datasets/input_file.h"
#include "datasets/walk.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDisparities = 1024;
constexpr std::array<std::string_view, 7> kColumns = {"left", "right", "name",         "gt",
                                                      "mask", "calib", "max_disparity"};

struct Line {
  int number;
  std::vector<std::string> fields;
};

// Quoted fields may hold commas, line ends and doubled quotes. Spreadsheets put a byte order mark in front.
std::vector<Line> splitLines(const std::string& path, std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<Line> lines;
  Line line{1, {}};
  std::string field;
  bool quoted = false;
  int number = 1, quoted_since = 1;
  const auto endLine = [&] {
    line.fields.push_back(std::move(field));
    if (line.fields.size() > 1 || !line.fields.front().empty()) lines.push_back(std::move(line));
    line = {number, {}};
    field.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++number;
    if (quoted) {
      if (c != '"')
        field += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        field += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
      quoted_since = number;
    } else if (c == ',') {
      line.fields.push_back(std::move(field));
      field.clear();
    } else if (c == '\n') {
      endLine();
    } else if (c != '\r') {
      field += c;
    }
  }
  if (quoted) failAtLine(path, quoted_since, "a quote that begins here never ends");
  endLine();
  return lines;
}

SceneFiles sceneOf(const fs::path& manifest, const std::map<std::string, std::string>& fields) {
  const auto field = [&](const char* column) {
    const auto found = fields.find(column);
    return found == fields.end() ? std::string() : found->second;
  };
  const auto path = [&](const char* column) {
    const std::string text = field(column);
    return text.empty() ? text : (manifest.parent_path() / text).string();
  };
  SceneFiles files;
  files.layout = SceneLayout::kManifest;
  files.folder = fs::absolute(manifest).lexically_normal().parent_path().string();
  files.left = path("left");
  files.right = path("right");
  files.ground_truth = path("gt");
  files.nonoccluded = path("mask");
  files.calibration = path("calib");
  files.name = field("name").empty() ? fs::path(files.left).stem().string() : field("name");
  if (files.name.find('/') != files.name.npos || files.name.starts_with('.'))
    files.problem = "name is " + pomona::quoted(files.name) + "; it names result files, and may hold no '/'";
  for (const char* column : {"left", "right"})
    if (field(column).empty()) files.problem = std::string("expected a path under ") + column;
  int& count = files.num_disparities;
  if (const std::string text = field("max_disparity");
      !text.empty() && (!parseNumber(text, count) || count < 1 || count > kMostDisparities))
    files.problem =
        "max_disparity is " + pomona::quoted(text) + "; allowed: 1 to " + std::to_string(kMostDisparities);
  return files;
}

}  // namespace

std::vector<SceneFiles> readManifest(const std::string& path) {
  const std::string text = readFile(path);
  const std::vector<Line> lines = splitLines(path, text);
  const std::vector<std::string> header = lines.empty() ? std::vector<std::string>() : lines.front().fields;
  const auto named = [&](std::string_view column) {
    return std::find(header.begin(), header.end(), column) != header.end();
  };
  if (!named("left") || !named("right"))
    failAtLine(path, 1, "expected the names of the columns, left and right among them");
  for (const std::string& column : header) {
    if (std::find(kColumns.begin(), kColumns.end(), column) == kColumns.end())
      failAtLine(path, 1,
                 "unknown column " + pomona::quoted(column) +
                     "; allowed: left, right, name, gt, mask, calib, max_disparity");
    if (std::count(header.begin(), header.end(), column) > 1)
      failAtLine(path, 1, "a second column " + pomona::quoted(column));
  }

  std::vector<SceneFiles> scenes;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto& [number, fields] = lines[i];
    std::map<std::string, std::string> by_column;
    for (std::size_t k = 0; k < std::min(fields.size(), header.size()); ++k) by_column[header[k]] = fields[k];
    SceneFiles files = sceneOf(path, by_column);
    if (fields.size() > header.size())
      files.problem = "has " + std::to_string(fields.size()) + " fields; the first line names " +
                      std::to_string(header.size());
    if (!files.problem.empty())
      files.problem = path + ": line " + std::to_string(number) + ": " + files.problem;
    scenes.push_back(std::move(files));
  }
  return scenes;
}

}  // namespace pomona
