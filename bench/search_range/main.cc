// What Options::adaptive_range finds, saves and costs: recall of the true disparities, time and accuracy with
// and without it, scene by scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/accuracy/measure.h"
#include "bench/accuracy/table.h"
#include "core/cpu.h"
#include "engine/input.h"
#include "engine/search_bands.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

struct Arguments {
  std::string folder, preset = "balanced", mode = "dense", size;
  double range = 1;
  int rounds = 3;
};

struct Case {
  Scene scene;
  int disparities;
};

constexpr std::array kColumns = {"bands",   "searched %", "recall A", "recall N", "look ms", "ms without",
                                 "ms with", "gain",       "A bad-1",  "with",     "N bad-1", "with",
                                 "A bad-2", "with",       "N bad-2",  "with"};
constexpr std::array kDecimals = {1, 0, 2, 2, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2};
using Values = std::array<double, kColumns.size()>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double cpuMs() {
  constexpr double kMsPerS = 1000;
  return kMsPerS * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The scene resized so that it fills the width, or its disparities the range, whichever is smaller, and
/// repeated until it fills the frame: as in bench/speed/inputs.h.
Case resized(const Scene& scene, const std::string& size) {
  int width = 0, height = 0, disparities = 0;
  if (std::sscanf(size.c_str(), "%dx%d/D%d", &width, &height, &disparities) != 3 ||
      std::min({width, height, disparities}) < 1)
    throw std::invalid_argument("\"" + size + "\" is no size; an example of one: 1280x720/D128");
  double largest = 0;
  cv::minMaxLoc(scene.ground_truth, nullptr, &largest, nullptr, nullptr,
                scene.ground_truth == scene.ground_truth);  // NaN is unequal
  const double scale = std::min(1.0 * width / scene.left.cols, (disparities - 1) / largest);
  const auto fill = [&](const cv::Mat& image, int interpolation) {
    cv::Mat scaled, frame;
    if (image.empty()) return frame;
    cv::resize(image, scaled, {}, scale, scale, interpolation);
    cv::repeat(scaled, (height + scaled.rows - 1) / scaled.rows, (width + scaled.cols - 1) / scaled.cols,
               frame);
    return cv::Mat(frame(cv::Rect(0, 0, width, height)).clone());
  };
  const int smooth = scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC;
  Scene s;
  s.left = fill(scene.left, smooth);
  s.right = fill(scene.right, smooth);
  s.ground_truth = fill(scene.ground_truth, cv::INTER_NEAREST) * scale;
  s.nonoccluded = fill(scene.nonoccluded, cv::INTER_NEAREST);
  return {s, disparities};
}

Options optionsOf(const Arguments& a, int disparities, bool adaptive) {
  Options o = Options::preset(a.preset);
  o.num_disparities = disparities;
  o.mode = a.mode == "sparse" ? OutputMode::kSparse : OutputMode::kDense;
  o.threads = 1;
  o.adaptive_range = adaptive;
  return o;
}

double percentOf(double part, double whole) {
  return whole > 0 ? 100 * part / whole : kNan;
}

/// Of the truth, what lies in the range of its band: A, N.
std::array<double, 2> recallOf(const Scene& scene, std::span<const SearchBand> bands) {
  std::array<double, 2> known{}, held{};
  for (const SearchBand& band : bands)
    for (int y = band.y; y < band.y + band.height; ++y)
      for (int x = 0; x < scene.ground_truth.cols; ++x) {
        const double d = scene.ground_truth.at<float>(y, x) - band.min_disparity;
        if (std::isnan(d)) continue;
        const bool seen = !scene.nonoccluded.empty() && scene.nonoccluded.at<std::uint8_t>(y, x) == 255;
        for (int region = 0; region <= (seen ? 1 : 0); ++region) {
          ++known[region];
          held[region] += d >= 0 && d <= band.disparities - 1;
        }
      }
  return {percentOf(held[0], known[0]), percentOf(held[1], known[1])};
}

/// Fills the columns up to "look ms".
void measurePlan(const Case& c, int rounds, Values& values) {
  InputPair input;
  input.set(c.scene.left, c.scene.right, 1);
  SparseStage::Settings settings;
  settings.match.disparities = c.disparities;
  settings.isa = chooseIsa("");
  settings.threads = 1;
  SearchBands planner;
  const SearchBand whole{0, input.height(), 0, c.disparities};
  std::span<const SearchBand> bands;
  double look_ms = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const double begin_ms = cpuMs();
    bands = planner.plan(input.views(), settings);
    look_ms = std::min(look_ms, cpuMs() - begin_ms);
  }
  const std::span<const SearchBand> cover = bands.empty() ? std::span(&whole, 1) : bands;
  double searched = 0;
  for (const SearchBand& band : cover) searched += 1.0 * band.height * band.disparities;
  const auto recall = recallOf(c.scene, cover);
  values[0] = static_cast<double>(bands.size());
  values[1] = percentOf(searched, 1.0 * whole.height * whole.disparities);
  values[2] = recall[0];
  values[3] = recall[1];
  values[4] = look_ms;
}

/// The least of the rounds, with and without in turns.
Values measureCase(const std::string& name, const Case& c, const Arguments& a) {
  Values values{};
  measurePlan(c, a.rounds, values);
  StereoEngine engines[2] = {StereoEngine(optionsOf(a, c.disparities, false)),
                             StereoEngine(optionsOf(a, c.disparities, true))};
  std::array<double, 2> ms;
  ms.fill(std::numeric_limits<double>::infinity());
  for (int round = 0; round < a.rounds; ++round)
    for (int with : {0, 1}) {
      const double begin_ms = cpuMs();
      const StereoResult& map = engines[with].compute(c.scene.left, c.scene.right);
      ms[with] = std::min(ms[with], cpuMs() - begin_ms);
      if (round > 0) continue;
      const SceneFigures f = sceneFigures(name, c.scene, {map.disparity, map.state, map.confidence});
      const std::array figures = {f.all[kBad1], f.nonoccluded[kBad1], f.all[kBad2], f.nonoccluded[kBad2]};
      for (std::size_t i = 0; i < figures.size(); ++i) values[8 + 2 * i + with] = figures[i];
    }
  values[5] = ms[0];
  values[6] = ms[1];
  values[7] = ms[0] / ms[1];
  return values;
}

void print(const std::string& name, const std::string& frame, const Values& values) {
  std::vector<std::string> cells = {name, frame};
  for (std::size_t i = 0; i < values.size(); ++i) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", kDecimals[i], values[i]);
    cells.emplace_back(std::isnan(values[i]) ? "-" : text);
  }
  addRow(std::cout, cells);
  std::cout.flush();
}

Values meanOf(const std::vector<Values>& rows) {
  Values mean{};
  for (std::size_t i = 0; i < mean.size(); ++i) {
    int known = 0;
    for (const Values& row : rows)
      if (!std::isnan(row[i])) {
        mean[i] += row[i];
        ++known;
      }
    mean[i] = known > 0 ? mean[i] / known : kNan;
  }
  return mean;
}

int run(const Arguments& a) {
  Failures failures("pomona_search_range");
  std::vector<std::string> header = {"scene", "frame"};
  header.insert(header.end(), kColumns.begin(), kColumns.end());
  addHeader(std::cout, header);
  std::vector<Values> rows;
  forEachScene(a.folder, failures, [&](const std::string& name, const Scene& scene, int disparities) {
    Case c = a.size.empty() ? Case{scene, disparities} : resized(scene, a.size);
    c.disparities = std::min({static_cast<int>(a.range * c.disparities), c.scene.left.cols, kMaxDisparities});
    rows.push_back(measureCase(name, c, a));
    print(name,
          std::to_string(c.scene.left.cols) + "x" + std::to_string(c.scene.left.rows) + "/D" +
              std::to_string(c.disparities),
          rows.back());
  });
  print("mean", "", meanOf(rows));
  return failures.count() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments a;
  CLI::App app("What Options::adaptive_range finds, saves and costs, on scenes in Middlebury's layout");
  app.add_option("scenes", a.folder, "folder below which the scenes lie")->required();
  app.add_option("--preset", a.preset, "fast, balanced (default) or quality");
  app.add_option("--mode", a.mode, "dense (default) or sparse")->check(CLI::IsMember({"dense", "sparse"}));
  app.add_option("--size", a.size, "resize the scenes, e.g. 1280x720/D128 (default: as they are)");
  app.add_option("--range", a.range, "search so many times the disparities that the scene needs")
      ->check(CLI::Range(1.0, 100.0));
  app.add_option("--rounds", a.rounds, "frames of each kind, in turns")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    return pomona::run(a);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_search_range: error: %s\n", error.what());
    return 1;
  }
}
