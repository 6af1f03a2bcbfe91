// How long the stages of the `paper` preset take at full size and at the scales that the seed paper uses.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "datasets/image_file.h"
#include "filters/joint_bilateral.h"
#include "filters/kernels.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

constexpr std::array<int, 4> kFactors = {1, 2, 4, 5};
constexpr const char* kBilateral = "joint bilateral completion";

struct Arguments {
  std::string left, right;
  int num_disparities = 64;
  int threads = 0;
  int repetitions = 5;
};

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double millisecondsOf(const auto& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// One scale: the median time of each stage of the sparse map, and of its completion, in order.
struct ScaleTimes {
  cv::Size size;
  int num_disparities = 0;
  std::vector<std::string> stages;
  std::map<std::string, double> milliseconds;

  double semiGlobalMatching() const {
    double sum = 0;
    for (const auto& [stage, time] : milliseconds) sum += stage == kBilateral ? 0 : time;
    return sum;
  }
};

cv::Mat shrunk(const cv::Mat& view, int factor) {
  cv::Mat small;
  const cv::Size size((view.cols + factor - 1) / factor, (view.rows + factor - 1) / factor);
  cv::resize(view, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

ScaleTimes timeScale(const Arguments& arguments, const cv::Mat& full_left, const cv::Mat& full_right,
                     int factor) {
  const cv::Mat left = shrunk(full_left, factor), right = shrunk(full_right, factor);
  Options options = Options::preset("paper");
  options.mode = OutputMode::kSparse;
  options.num_disparities = (arguments.num_disparities + factor - 1) / factor;
  options.threads = arguments.threads;
  StereoEngine engine(options);
  const int threads = arguments.threads > 0 ? arguments.threads : availableThreads();
  const FilterKernels& kernels = filterKernels(chooseIsa(""));
  const GuideView guide{left.ptr(), left.cols, left.rows, left.channels(),
                        static_cast<std::ptrdiff_t>(left.step[0])};
  Arena scratch;
  Image<float> completed(left.cols, left.rows);

  ScaleTimes times{left.size(), options.num_disparities, {}, {}};
  std::map<std::string, std::vector<double>> samples;
  engine.compute(left, right);  // buffers are allocated here
  for (int i = 0; i < arguments.repetitions; ++i) {
    const StereoResult& result = engine.compute(left, right);
    for (const StageTiming& timing : result.timings)
      samples[std::string(timing.stage)].push_back(timing.milliseconds);
    const cv::Mat& d = result.disparity;
    const ImageView<const float> sparse{d.ptr<float>(), d.cols, d.rows,
                                        static_cast<std::ptrdiff_t>(d.step1())};
    samples[kBilateral].push_back(millisecondsOf([&] {
      completeByBilateral(
          sparse, guide,
          {options.completion.sigma_space_px, options.completion.sigma_range, BilateralTarget::kEveryPixel},
          completed.view(), scratch, kernels, threads);
    }));
    if (i > 0) continue;
    for (const StageTiming& timing : result.timings) times.stages.emplace_back(timing.stage);
    times.stages.emplace_back(kBilateral);
  }
  for (const auto& [stage, values] : samples) times.milliseconds[stage] = medianOf(values);
  return times;
}

double timeWholePreset(const Arguments& arguments, const cv::Mat& left, const cv::Mat& right) {
  Options options = Options::preset("paper");
  options.num_disparities = arguments.num_disparities;
  options.threads = arguments.threads;
  StereoEngine engine(options);
  engine.compute(left, right);
  std::vector<double> samples;
  for (int i = 0; i < arguments.repetitions; ++i)
    samples.push_back(millisecondsOf([&] { engine.compute(left, right); }));
  return medianOf(samples);
}

void printTable(const std::vector<ScaleTimes>& scales, double whole_ms) {
  constexpr double kPaperSgm_ms = 320800, kPaperBilateral_ms = 1038000, kPaperTwoScales_s = 104;
  constexpr double kMsPerS = 1000;
  const auto row = [&](const std::string& name, auto cell, const char* paper) {
    std::printf("| %s |", name.c_str());
    for (const ScaleTimes& scale : scales) std::printf(" %s |", cell(scale).c_str());
    std::printf(" %s |\n", paper);
  };
  const auto number = [](double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.2f", value);
    return std::string(text.data());
  };
  const auto grouped = [](double value) {  // 1038000 as 1,038,000
    std::string digits = std::to_string(std::lround(value));
    for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3) digits.insert(i, 1, ',');
    return digits;
  };
  std::printf(
      "| milliseconds | full | 1/2 | 1/4 | 1/5 | the paper, full size |\n|---|--:|--:|--:|--:|--:|\n");
  row(
      "size",
      [](const ScaleTimes& s) { return std::to_string(s.size.width) + "x" + std::to_string(s.size.height); },
      "");
  row(
      "disparities", [](const ScaleTimes& s) { return std::to_string(s.num_disparities); }, "");
  for (const std::string& stage : scales.front().stages)
    if (stage != kBilateral)
      row(
          stage, [&](const ScaleTimes& s) { return number(s.milliseconds.at(stage)); }, "");
  row(
      "**SGM and checks, sum**", [&](const ScaleTimes& s) { return number(s.semiGlobalMatching()); },
      grouped(kPaperSgm_ms).c_str());
  row(
      std::string("**") + kBilateral + "**",
      [&](const ScaleTimes& s) { return number(s.milliseconds.at(kBilateral)); },
      grouped(kPaperBilateral_ms).c_str());
  const double full_ms = scales.front().semiGlobalMatching() + scales.front().milliseconds.at(kBilateral);
  const double paper_ms = kPaperSgm_ms + kPaperBilateral_ms;
  std::printf("\n| both scales, completed, enlarged and fused | here | the paper |\n|---|--:|--:|\n");
  std::printf("| time | %.1f ms | about %.0f s |\n", whole_ms, kPaperTwoScales_s);
  std::printf("| gain over SGM and bilateral at full size | %.1f times | %.1f times |\n", full_ms / whole_ms,
              paper_ms / kMsPerS / kPaperTwoScales_s);
}

void run(const Arguments& arguments) {
  if (arguments.repetitions < 1 || arguments.num_disparities < 1)
    throw std::invalid_argument("--repetitions and --disparities must be at least 1");
  const cv::Mat left = readImage(arguments.left), right = readImage(arguments.right);
  if (left.depth() != CV_8U) throw std::runtime_error(arguments.left + ": expected 8 bits");
  std::vector<ScaleTimes> scales;
  for (const int factor : kFactors) scales.push_back(timeScale(arguments, left, right, factor));
  const double whole_ms = timeWholePreset(arguments, left, right);
  std::printf("Here: %s, %s, %d threads; medians of %d runs. The paper: Intel i5-1035G1.\n\n",
              std::string(cpuModel()).c_str(), std::string(name(chooseIsa(""))).c_str(),
              arguments.threads > 0 ? arguments.threads : availableThreads(), arguments.repetitions);
  printTable(scales, whole_ms);
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  pomona::Arguments arguments;
  CLI::App app("Run time of the paper preset by stage and scale");
  app.add_option("left", arguments.left, "left view, 8 bits")->required();
  app.add_option("right", arguments.right, "right view")->required();
  app.add_option("--disparities", arguments.num_disparities, "searched at full size (default 64)");
  app.add_option("--threads", arguments.threads, "worker threads (default 0: one per processor)");
  app.add_option("--repetitions", arguments.repetitions, "runs of which the median counts (default 5)");
  CLI11_PARSE(app, argc, argv);
  try {
    pomona::run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_paper_times: error: %s\n", error.what());
    return 1;
  }
}
