// Fits the sub-pixel curve of our matching cost on rendered scenes, where the true disparity is known
// exactly.
//
// With S the aggregated sums, A = S[d-1] - S[d], C = S[d+1] - S[d] and r = min(A, C) / max(A, C), the true
// minimum lies at f(r) from d towards the smaller of A and C. f(0) = 1/2 (the neighbour is as good as d) and
// f(1) = 0 (symmetry) hold for any cost; what lies between depends on the cost's shape. The model is f = 1/2
// - a r - (1/2 - a) r^2. Prints the mean true offset per bin of r, the fitted a, and the rms error of every
// curve.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "datasets/named_scenes.h"
#include "datasets/render.h"
#include "engine/input.h"
#include "sgm/matcher.h"

namespace pomona {
namespace {

struct Sample {
  double r, offset;
};

/// Pixels of row y that are seen by both cameras and whose winner is the whole disparity next to the truth.
void collect(const RenderedPair& pair, int y, const WinnerRow& w, std::vector<Sample>& samples) {
  for (int x = 0; x < pair.left.image.cols; ++x) {
    const int d = w.index[x];
    const double truth = pair.left.disparity.at<float>(y, x);
    if (pair.left.mask.at<std::uint8_t>(y, x) != 255 || d == 0 || d + 1 == w.disparities) continue;
    if (!(std::abs(truth - d) < 0.75)) continue;
    const double below = w.below[x] - w.best[x], above = w.above[x] - w.best[x];
    if (std::max(below, above) == 0) continue;
    const double towards_smaller = below < above ? d - truth : truth - d;
    samples.push_back({std::min(below, above) / std::max(below, above), towards_smaller});
  }
}

double rms(const std::vector<Sample>& samples, double (*curve)(double r, double a), double a) {
  double sum = 0;
  for (const Sample& s : samples) sum += (s.offset - curve(s.r, a)) * (s.offset - curve(s.r, a));
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

double quadratic(double r, double a) {
  return 0.5 - a * r - (0.5 - a) * r * r;
}
double parabola(double r, double) {
  return (1 - r) / (2 * (1 + r));
}

int fit() {
  const Options options = Options::preset("balanced");
  const SgmKernels& kernels = sgmKernels(chooseIsa({}));
  constexpr int kDisparities = 64;
  std::vector<Sample> samples;
  for (const char* name : {"planes", "spheres", "boxes"})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const RenderedPair pair = render(namedScene(name, seed, 640, 400, 56));
      InputPair input;
      input.set(pair.left.image, pair.right.image, availableThreads());
      SgmMatcher matcher;
      Arena scratch;
      matcher.findWinners(
          input.views(), {0, kDisparities, options.cost, options.aggregation, options.winner}, {}, kernels,
          [&](int y, const WinnerRow& winners) { collect(pair, y, winners, samples); }, scratch, 1);
    }

  constexpr int kBins = 20;
  double sum[kBins] = {};
  int count[kBins] = {};
  double xx = 0, xy = 0;  // least squares of (offset - 1/2 + r^2 / 2) on a: (r^2 - r) a
  for (const Sample& s : samples) {
    const int bin = std::min(kBins - 1, static_cast<int>(s.r * kBins));
    sum[bin] += s.offset;
    ++count[bin];
    const double x = s.r * s.r - s.r, y = s.offset - 0.5 + 0.5 * s.r * s.r;
    xx += x * x;
    xy += x * y;
  }
  const double a = xy / xx;
  std::printf("samples %zu\n   r     mean offset   fitted\n", samples.size());
  for (int b = 0; b < kBins; ++b) {
    const double r = (b + 0.5) / kBins;
    std::printf("%.3f   %10.4f   %.4f\n", r, count[b] ? sum[b] / count[b] : 0, quadratic(r, a));
  }
  std::printf("a = %.4f\nrms: fitted %.4f, a = 1/4 %.4f, equiangular (a = 1/2) %.4f, parabola %.4f\n", a,
              rms(samples, quadratic, a), rms(samples, quadratic, 0.25), rms(samples, quadratic, 0.5),
              rms(samples, parabola, 0));
  return 0;
}

}  // namespace
}  // namespace pomona

int main() {
  return pomona::fit();
}
