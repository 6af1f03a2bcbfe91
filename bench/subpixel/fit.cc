// Fits the sub-pixel curve of our matching cost on rendered scenes, where the true disparity is known
// exactly.
//
// With S the aggregated sums, A = S[d-1] - S[d], C = S[d+1] - S[d] and r = min(A, C) / max(A, C), the true
// minimum lies at f(r) from d towards the smaller of A and C. f(0) = 1/2 (the neighbour is as good as d) and
// f(1) = 0 (symmetry) hold for any cost; what lies between depends on the cost's shape and on the number of
// paths. The model is f = 1/2 - a r - b r^2 - (1/2 - a - b) r^3. Prints, for 4 and for 8 paths, the mean true
// offset per bin of r, the fitted a and b, and the rms error of every curve.
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

double at(const SubpixelCurve& curve, double r) {
  return 0.5 - r * (curve.a + r * (curve.b + r * curve.c));
}

template <typename Curve>
double rms(const std::vector<Sample>& samples, const Curve& curve) {
  double sum = 0;
  for (const Sample& s : samples) sum += (s.offset - curve(s.r)) * (s.offset - curve(s.r));
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

std::vector<Sample> samplesOf(Options options) {
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

  return samples;
}

/// Least squares of offset - (1 - r^3) / 2 on a (r^3 - r) + b (r^3 - r^2).
SubpixelCurve fitted(const std::vector<Sample>& samples) {
  double xx = 0, xz = 0, zz = 0, xy = 0, zy = 0;
  for (const Sample& s : samples) {
    const double cube = s.r * s.r * s.r, x = cube - s.r, z = cube - s.r * s.r,
                 y = s.offset - 0.5 * (1 - cube);
    xx += x * x;
    xz += x * z;
    zz += z * z;
    xy += x * y;
    zy += z * y;
  }
  const double determinant = xx * zz - xz * xz;
  const double a = (xy * zz - zy * xz) / determinant, b = (zy * xx - xy * xz) / determinant;
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(0.5 - a - b)};
}

void report(int paths) {
  Options options = Options::preset("balanced");
  options.aggregation.paths = paths;
  const std::vector<Sample> samples = samplesOf(options);
  const SubpixelCurve curve = fitted(samples), in_use = subpixelCurve(paths);
  constexpr int kBins = 20;
  double sum[kBins] = {};
  int count[kBins] = {};
  for (const Sample& s : samples) {
    const int bin = std::min(kBins - 1, static_cast<int>(s.r * kBins));
    sum[bin] += s.offset;
    ++count[bin];
  }
  std::printf("%d paths, %zu samples\n   r     mean offset   fitted   in use\n", paths, samples.size());
  for (int b = 0; b < kBins; ++b) {
    const double r = (b + 0.5) / kBins;
    std::printf("%.3f   %10.4f   %.4f   %.4f\n", r, count[b] ? sum[b] / count[b] : 0, at(curve, r),
                at(in_use, r));
  }
  std::printf("a = %.4f, b = %.4f\nrms: fitted %.4f, in use %.4f, equiangular %.4f, parabola %.4f\n\n",
              curve.a, curve.b, rms(samples, [&](double r) { return at(curve, r); }),
              rms(samples, [&](double r) { return at(in_use, r); }),
              rms(samples, [](double r) { return 0.5 * (1 - r); }),
              rms(samples, [](double r) { return (1 - r) / (2 * (1 + r)); }));
}

}  // namespace
}  // namespace pomona

int main() {
  for (const int paths : {4, 8}) pomona::report(paths);
}
