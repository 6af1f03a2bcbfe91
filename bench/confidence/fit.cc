// Fits confidence and sigma_px (engine/trust.cc) on rendered scenes: no real scene is learned.
//
// The scenes are made harder than they are rendered, in ways real ones are: surfaces lose up to 95 % of their
// contrast, and the views get noise, blur, a difference of gain, and lines that are off by a fraction of a
// pixel, as calibrations leave them. Truth is exact. Presets are pooled. The measured pixels are counted in
// cells of equal features; a logistic regression gives the log odds of being right to within a pixel, a
// linear one the logarithm of the error that 68.3 % of a cell's pixels keep. Pixels at which no disparity
// stands out are of two kinds, those the light left little of and those with nothing on them: they are taken
// in equal parts from these scenes and from noiseless ones with bare surfaces, which serve for nothing else.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "engine/input.h"
#include "engine/pipeline.h"
#include "engine/trust.h"

namespace pomona {
namespace {

constexpr int kDisparities = 64;
constexpr double kWithinOneSigma = 0.6827;
constexpr double kCalibrationError_px = 0.3;
constexpr int kTerms = 6;  // those of engine/trust.cc
using Terms = std::array<double, kTerms>;

/// Pixels alike.
struct Cell {
  std::vector<float> errors;  // |d - truth|

  double count() const { return static_cast<double>(errors.size()); }
  double right() const {
    return static_cast<double>(std::count_if(errors.begin(), errors.end(), [](float e) { return e <= 1; }));
  }
  double sigma() {
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(kWithinOneSigma * (count() - 1));
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
  }
};
struct Cells {
  std::map<int, Cell> measured;  // by the code of their features
  std::map<PixelState, Cell> filled;
  Cell bare;  // measured, but nothing stood out
};

SceneDescription fadedScene(const char* name, std::uint64_t seed, cv::RNG& random) {
  SceneDescription scene = namedScene(name, seed, 640, 400, 56);
  for (Surface& surface : scene.surfaces) {
    const double contrast = std::pow(10.0, random.uniform(-1.3, 0.0));
    surface.paint.second_bgr =
        surface.paint.first_bgr + contrast * (surface.paint.second_bgr - surface.paint.first_bgr);
  }
  return scene;
}

/// Half of the surfaces show nothing at all, like an overexposed sky.
SceneDescription bareScene(const char* name, std::uint64_t seed) {
  SceneDescription scene = namedScene(name, seed, 640, 400, 56);
  for (std::size_t i = 0; i < scene.surfaces.size(); i += 2)
    scene.surfaces[i].paint.second_bgr = scene.surfaces[i].paint.first_bgr;
  return scene;
}

cv::Mat photograph(const cv::Mat& view, double gain, double blur_px, double noise, cv::RNG& random) {
  cv::Mat light, grain(view.size(), CV_32FC3), image;
  view.convertTo(light, CV_32F, gain);
  if (blur_px > 0) cv::GaussianBlur(light, light, {}, blur_px);
  random.fill(grain, cv::RNG::NORMAL, 0, noise);
  cv::Mat(light + grain).convertTo(image, CV_8U);
  return image;
}

/// The view of a rig whose calibration is off by up to `error_px` in either direction, slowly varying.
cv::Mat misaligned(const cv::Mat& view, double error_px, cv::RNG& random) {
  const double period_px = 300, phase_x = random.uniform(0.0, 2 * CV_PI),
               phase_y = random.uniform(0.0, 2 * CV_PI);
  cv::Mat columns(view.size(), CV_32F), rows(view.size(), CV_32F), result;
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x) {
      const double u = 2 * CV_PI * x / period_px, v = 2 * CV_PI * y / period_px;
      columns.at<float>(y, x) = static_cast<float>(x + error_px * std::sin(u + phase_x) * std::cos(v));
      rows.at<float>(y, x) = static_cast<float>(y + error_px * std::sin(v + phase_y) * std::cos(u));
    }
  cv::remap(view, result, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

void collect(const char* preset, const cv::Mat& left, const cv::Mat& right, const cv::Mat& truth,
             Cells& cells) {
  Options options = Options::preset(preset);
  options.num_disparities = kDisparities;
  InputPair input;
  input.set(left, right, availableThreads());
  Pipeline pipeline(options, chooseIsa({}), availableThreads());
  StageClock untimed;
  pipeline.run(input.views(), {}, untimed);
  const MatchMaps& maps = pipeline.maps();
  std::uint16_t codes[kMatchChunk];
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      if (x % kMatchChunk == 0)
        trustCodes(maps, pipeline.largestCostSum(), y, x, std::min(kMatchChunk, truth.cols - x),
                   pipeline.filterKernels(), codes);
      const float error = std::fabs(maps.disparity.row(y)[x] - truth.at<float>(y, x));
      if (std::isnan(error)) continue;
      const auto state = static_cast<PixelState>(maps.state.row(y)[x]);
      if (state == PixelState::kMeasured && TrustFeatures::of(codes[x % kMatchChunk]).bare) {
        cells.bare.errors.push_back(error);
      } else if (state == PixelState::kMeasured) {
        cells.measured[codes[x % kMatchChunk]].errors.push_back(error);
      } else {
        cells.filled[state].errors.push_back(error);
      }
    }
}

Terms termsOf(int code) {
  const TrustFeatures f = TrustFeatures::of(code);
  const bool none = f.residual == kTrustSteps - 1;
  return {1,
          static_cast<double>(f.margin),
          static_cast<double>(f.margin * f.margin),
          static_cast<double>(f.curvature),
          none ? 0.0 : f.residual,
          none ? 1.0 : 0.0};
}

double dot(const Terms& a, const Terms& b) {
  double sum = 0;
  for (int i = 0; i < kTerms; ++i) sum += a[i] * b[i];
  return sum;
}

/// Least squares: the terms whose weighted normal equations are A c = b.
struct NormalEquations {
  cv::Matx<double, kTerms, kTerms> a = cv::Matx<double, kTerms, kTerms>::zeros();
  cv::Vec<double, kTerms> b = cv::Vec<double, kTerms>::all(0);

  void add(const Terms& t, double value, double weight) {
    for (int i = 0; i < kTerms; ++i) {
      b[i] += weight * t[i] * value;
      for (int j = 0; j < kTerms; ++j) a(i, j) += weight * t[i] * t[j];
    }
  }
  Terms solution() const {
    const cv::Vec<double, kTerms> c = a.solve(b, cv::DECOMP_CHOLESKY);
    Terms result;
    std::copy_n(c.val, kTerms, result.begin());
    return result;
  }
};

/// Iteratively reweighted least squares.
Terms fitLogOdds(std::map<int, Cell>& cells) {
  Terms fit{2.0};
  for (int iteration = 0; iteration < 20; ++iteration) {
    NormalEquations equations;
    for (auto& [code, cell] : cells) {
      const Terms t = termsOf(code);
      const double z = dot(fit, t), p = 1 / (1 + std::exp(-z)), weight = std::max(1e-6, p * (1 - p));
      equations.add(t, z + (cell.right() / cell.count() - p) / weight, weight * cell.count());
    }
    fit = equations.solution();
  }
  return fit;
}

Terms fitLogSigma(std::map<int, Cell>& cells) {
  NormalEquations equations;
  for (auto& [code, cell] : cells)
    if (cell.count() >= 50)
      equations.add(termsOf(code), std::log(std::max(0.01, cell.sigma())), cell.count());
  return equations.solution();
}

void print(const char* name, const Terms& fit) {
  std::printf("%s = {", name);
  for (const double& term : fit) std::printf("%.5g%s", term, &term == &fit.back() ? "}\n" : ", ");
}

/// As many pixels of one as of the other, the rest evenly left out.
Cell halfOfEach(const Cell& a, const Cell& b) {
  const std::size_t count = std::min(a.errors.size(), b.errors.size());
  Cell both;
  for (const Cell* cell : {&a, &b})
    for (std::size_t i = 0; i < count; ++i)
      both.errors.push_back(cell->errors[i * cell->errors.size() / count]);
  return both;
}

void print(const char* kind, Cell cell) {
  std::printf("%-24s %8.0f pixels: confidence %.2f, sigma %.2f px\n", kind, cell.count(),
              cell.right() / cell.count(), cell.sigma());
}

int fit() {
  Cells cells, paper, bare;
  cv::RNG random(7);
  for (const char* name : {"planes", "spheres", "boxes", "trees"})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const RenderedPair pair = render(fadedScene(name, seed, random));
      const double noise = 0.8 * static_cast<double>(seed), blur_px = seed % 2 == 0 ? 0.7 : 0;
      const cv::Mat left = photograph(pair.left.image, 1, blur_px, noise, random);
      const cv::Mat right = photograph(misaligned(pair.right.image, kCalibrationError_px, random),
                                       random.uniform(0.9, 1.1), blur_px, noise, random);
      for (const char* preset : {"fast", "balanced", "quality"})
        collect(preset, left, right, pair.left.disparity, cells);
      const RenderedPair half_bare = render(bareScene(name, seed));
      for (const char* preset : {"fast", "balanced", "quality"})
        collect(preset, half_bare.left.image, half_bare.right.image, half_bare.left.disparity, bare);
      collect("paper", left, right, pair.left.disparity, paper);
    }
  print("kLogOdds", fitLogOdds(cells.measured));
  print("kLogSigma", fitLogSigma(cells.measured));
  cells.filled[PixelState::kFilledCoarse] = paper.filled[PixelState::kFilledCoarse];
  for (auto& [state, cell] : cells.filled) print(name(state).data(), cell);
  print("nothing stands out", halfOfEach(cells.bare, bare.bare));
  return 0;
}

}  // namespace
}  // namespace pomona

int main() {
  return pomona::fit();
}
