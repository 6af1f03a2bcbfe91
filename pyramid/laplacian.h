// Gaussian and Laplacian pyramids of float maps of any size.
//
// P. J. Burt and E. H. Adelson, "The Laplacian pyramid as a compact image code", IEEE Trans. Communications
// 31(4), 1983, with the generating kernel [1 4 6 4 1] / 16 and replicated borders. Maps must be dense: a NaN
// would spread over its neighbourhood on every level.
#pragma once

#include <array>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

constexpr int kMaxPyramidLevels = 16;

/// REDUCE: low-pass, then every second sample, from n to (n + 1) / 2 on both axes, which is the size `out`
/// has.
void reduce(ImageView<const float> in, ImageView<float> out, Arena& scratch, const PyramidKernels& kernels,
            int threads);

/// inout += gain * EXPAND(in): `in` has (n + 1) / 2 samples where `inout` has n, on both axes.
void addExpanded(ImageView<const float> in, float gain, ImageView<float> inout, Arena& scratch,
                 const PyramidKernels& kernels, int threads);

/// Level 0 is the map itself, each further one the REDUCE of the one before.
class GaussianPyramid {
 public:
  /// Builds up to `levels` levels (1..kMaxPyramidLevels), fewer if a side reaches 1 before, in the current
  /// scope of `arena`.
  void build(ImageView<const float> map, int levels, const PyramidKernels& kernels, Arena& arena,
             int threads);

  int levels() const { return levels_; }
  ImageView<float> level(int i) const { return images_[static_cast<std::size_t>(i)]; }

 private:
  std::array<ImageView<float>, kMaxPyramidLevels> images_;
  int levels_ = 0;
};

/// Level i is G_i - EXPAND(G_i+1), the band that REDUCE loses; the last level is what remains of G.
class LaplacianPyramid {
 public:
  /// As GaussianPyramid::build().
  void build(ImageView<const float> map, int levels, const PyramidKernels& kernels, Arena& arena,
             int threads);
  /// The map whose pyramid this is, up to float rounding, into `out`, which has the size of level 0.
  /// Uses up the pyramid: levels hold Gaussian levels afterwards.
  void collapse(ImageView<float> out, const PyramidKernels& kernels, Arena& scratch, int threads);

  int levels() const { return bands_.levels(); }
  ImageView<float> level(int i) const { return bands_.level(i); }

 private:
  GaussianPyramid bands_;
};

}  // namespace pomona
