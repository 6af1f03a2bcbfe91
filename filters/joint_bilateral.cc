#include "filters/joint_bilateral.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/parallel.h"
#include "filters/padded_plane.h"

namespace pomona {
namespace {

constexpr int kBlock = kBilateralBlock;
static_assert(PaddedPlane::kOverrun >= kBlock - 1);

void requirePositive(const char* name, float value) {
  if (!(value > 0.0f) || !std::isfinite(value))
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; allowed: > 0");
}

/// One frame's filter: the guide is read once, disparities once per pass.
class Filter {
 public:
  Filter(ImageView<const float> size, GuideView guide, const BilateralParameters& parameters, Arena& scratch,
         const FilterKernels& kernels, int threads);

  /// Filters `in` into `out`, which may be the same.
  void run(ImageView<const float> in, ImageView<float> out, BilateralTarget target);

 private:
  void readGuide(GuideView guide, Arena& scratch);
  void readDisparity(ImageView<const float> in, int y) const;
  bool anyKnownNear(int y, int block) const;
  void filterRow(ImageView<const float> in, ImageView<float> out, BilateralTarget target, int y) const;

  const FilterKernels& kernels_;
  int threads_;
  int width_, height_;
  int blocks_;                                 ///< per row
  PaddedPlane disparity_, centre_, guide_[3];  // see BilateralWindow
  ImageView<std::uint8_t> occupied_;           // 1 if a block of kBilateralBlock pixels has a known one
  BilateralWindow window_{};
};

Filter::Filter(ImageView<const float> size, GuideView guide, const BilateralParameters& parameters,
               Arena& scratch, const FilterKernels& kernels, int threads)
    : kernels_(kernels),
      threads_(threads),
      width_(size.width),
      height_(size.height),
      blocks_((size.width + kBlock - 1) / kBlock) {
  requirePositive("sigma_space_px", parameters.sigma_space_px);
  requirePositive("sigma_range", parameters.sigma_range);
  if (guide.channels != 1 && guide.channels != 3)
    throw std::invalid_argument("guide channels are " + std::to_string(guide.channels) + "; allowed: 1, 3");

  const double log2_e = std::numbers::log2e;
  const double sigma_space = parameters.sigma_space_px, sigma_range = parameters.sigma_range;
  const int radius = static_cast<int>(std::ceil(2 * sigma_space));
  const int side = 2 * radius + 1;
  float* log_weight = scratch.take<float>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  window_.log_weight = log_weight;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx)
      *log_weight++ = static_cast<float>(-(dx * dx + dy * dy) * log2_e / (2 * sigma_space * sigma_space));

  window_.channels = guide.channels;
  window_.radius = radius;
  window_.range_scale = static_cast<float>(log2_e / (2 * sigma_range * sigma_range * guide.channels));
  readGuide(guide, scratch);
}

void Filter::readGuide(GuideView guide, Arena& scratch) {
  const int radius = window_.radius;
  const auto plane = [&](float border) { return PaddedPlane(scratch, width_, height_, radius, border); };
  disparity_ = plane(0.0f);
  centre_ = plane(0.0f);
  guide_[0] = plane(std::numeric_limits<float>::infinity());
  for (int c = 1; c < guide.channels; ++c) guide_[c] = plane(0.0f);
  occupied_ = scratch.image<std::uint8_t>(blocks_, height_);
  window_.stride = disparity_.stride();
  parallelStrips(threads_, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int c = 0; c < guide.channels; ++c) {
        const std::uint8_t* from = guide.row(y) + c;
        float* to = (c == 0 ? centre_ : guide_[c]).row(y);
        for (int x = 0; x < width_; ++x) to[x] = static_cast<float>(from[x * guide.channels]);
      }
  });
}

/// Unknown pixels get an infinite guide difference, hence no weight: the kernel need not test for them.
void Filter::readDisparity(ImageView<const float> in, int y) const {
  const float* from = in.row(y);
  const float* centre = centre_.row(y);
  float* disparity = disparity_.row(y);
  float* masked = guide_[0].row(y);
  for (int block = 0; block < blocks_; ++block) {
    bool any_known = false;
    for (int x = block * kBlock; x < std::min(width_, (block + 1) * kBlock); ++x) {
      const bool known = !std::isnan(from[x]);
      disparity[x] = known ? from[x] : 0.0f;
      masked[x] = known ? centre[x] : std::numeric_limits<float>::infinity();
      any_known |= known;
    }
    occupied_.row(y)[block] = any_known;
  }
}

/// False only if no window of the block's pixels contains a known pixel.
bool Filter::anyKnownNear(int y, int block) const {
  const int reach = (window_.radius + kBlock - 1) / kBlock;
  const int first = std::max(0, block - reach), last = std::min(blocks_ - 1, block + reach);
  const int y_last = std::min(height_ - 1, y + window_.radius);
  for (int v = std::max(0, y - window_.radius); v <= y_last; ++v) {
    const std::uint8_t* occupied = occupied_.row(v);
    if (std::any_of(occupied + first, occupied + last + 1, [](std::uint8_t o) { return o != 0; }))
      return true;
  }
  return false;
}

void Filter::filterRow(ImageView<const float> in, ImageView<float> out, BilateralTarget target, int y) const {
  const auto is_target = [&](float d) { return target == BilateralTarget::kEveryPixel || std::isnan(d); };
  for (int block = 0; block < blocks_; ++block) {
    const int x = block * kBlock, count = std::min(kBlock, width_ - x);
    const float* from = in.row(y) + x;
    float* to = out.row(y) + x;
    alignas(64) float filtered[kBlock];
    if (std::any_of(from, from + count, is_target) && anyKnownNear(y, block)) {
      BilateralWindow window = window_;
      window.disparity = disparity_.row(y) + x;
      window.centre = centre_.row(y) + x;
      for (int c = 0; c < window.channels; ++c) window.guide[c] = guide_[c].row(y) + x;
      kernels_.jointBilateral(window, filtered);
      for (int i = 0; i < count; ++i) to[i] = is_target(from[i]) ? filtered[i] : from[i];
    } else if (to != from) {
      std::copy_n(from, count, to);
    }
  }
}

void Filter::run(ImageView<const float> in, ImageView<float> out, BilateralTarget target) {
  parallelStrips(threads_, height_, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) readDisparity(in, y);
  });
  parallelStrips(threads_, height_, 2, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) filterRow(in, out, target, y);
  });
}

int countHoles(ImageView<const float> map) {
  int holes = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) holes += std::isnan(map.at(y, x));
  return holes;
}

}  // namespace

void jointBilateral(ImageView<const float> in, GuideView guide, const BilateralParameters& parameters,
                    ImageView<float> out, Arena& scratch, const FilterKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  Filter(in, guide, parameters, scratch, kernels, threads).run(in, out, parameters.target);
}

void completeByBilateral(ImageView<const float> in, GuideView guide, const BilateralParameters& parameters,
                         ImageView<float> out, Arena& scratch, const FilterKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  Filter filter(in, guide, parameters, scratch, kernels, threads);
  int before = countHoles(in);
  filter.run(in, out, parameters.target);
  for (int holes = countHoles(out); holes != 0 && holes != before; holes = countHoles(out)) {
    before = holes;
    filter.run(out, out, BilateralTarget::kHolesOnly);
  }
}

}  // namespace pomona
