#include "pyramid/hole_fill.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"
#include "pyramid/hole_rays.h"
#include "pyramid/holes.h"

namespace pomona {
namespace {

constexpr std::size_t kRowRays = 2;  // kRays[0] and [1]
constexpr double kColorScale = 12;
constexpr double kDistanceScale_px = 30;
constexpr int kMinBatchesPerStrip = 16;
constexpr int kMinLinesPerStrip = 16;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::uint32_t integerWeight(double exponent) {
  return static_cast<std::uint32_t>(std::lround(65535 * std::exp(-exponent)));
}

// std::min, but NaN counts as absent.
float smaller(float a, float b) {
  return std::isnan(a) || b < a ? b : a;
}

bool isBackground(std::uint8_t state) {
  const PixelState s = static_cast<PixelState>(state);
  return s == PixelState::kOccluded || s == PixelState::kOutOfRange;
}

std::uint8_t filledState(std::uint8_t state) {
  return static_cast<std::uint8_t>(isBackground(state) ? PixelState::kFilledBackground
                                                       : PixelState::kFilledInterpolated);
}

// Fills holes in batches. Only holes are written, and only sources decide: the order of the batches is of no
// account.
class HoleFiller {
 public:
  HoleFiller(const HoleFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
             const HoleRays& rays, Arena& arena, const PyramidKernels& kernels)
      : in_(in), disparity_(disparity), state_(state), rays_(rays), kernels_(kernels) {
    tabulateWeights(arena);
  }

  int batches() const { return (rays_.count() + kHoleBatch - 1) / kHoleBatch; }

  // False if a hole is left NaN: no source is within its reach.
  bool fillBatch(int batch) {
    const int first = batch * kHoleBatch, n = std::min(kHoleBatch, rays_.count() - first);
    std::int32_t x[kHoleBatch], y[kHoleBatch];
    for (int i = 0; i < n; ++i) {
      const HoleRays::Pixel p = rays_.holes()[first + i];
      x[i] = p.x;
      y[i] = p.y;
    }
    float candidates[kRays.size() * kHoleBatch], chosen[kHoleBatch];
    std::uint32_t weights[kRays.size() * kHoleBatch];
    for (std::size_t k = 0; k < kRays.size(); ++k) {
      const std::size_t plane = k * static_cast<std::size_t>(n);
      kernels_.gatherCandidates(sources_[k], x, y, rays_.steps(k) + first, n, candidates + plane,
                                weights + plane);
    }
    kernels_.candidateMedian(candidates, weights, n, chosen);
    bool complete = true;
    for (int i = 0; i < n; ++i)
      complete &= fillHole(first + i, std::isinf(chosen[i]) ? leastImpossible(first + i) : chosen[i]);
    return complete;
  }

  // For a hole that fillBatch() left NaN. False if it stays so.
  bool fillFromCoarse(int hole, ImageView<const float> coarse) {
    const HoleRays::Pixel p = rays_.holes()[hole];
    float& disparity = disparity_.at(p.y, p.x);
    if (!std::isnan(disparity)) return true;
    disparity = coarse.at(p.y, p.x);
    if (std::isnan(disparity)) return false;
    state_.at(p.y, p.x) = static_cast<std::uint8_t>(PixelState::kFilledCoarse);
    return true;
  }

 private:
  void tabulateWeights(Arena& arena) {
    const int channels = in_.guide.channels;
    std::uint32_t* const color_weight = arena.take<std::uint32_t>(3 * 255 + 1);
    for (int i = 0; i <= 3 * 255; ++i) color_weight[i] = integerWeight(i / (channels * kColorScale));
    const int longest = std::max(disparity_.width, disparity_.height);  // in steps
    std::uint32_t* const distance_weight = arena.take<std::uint32_t>(static_cast<std::size_t>(longest));
    for (int i = 0; i < longest && i <= in_.search_radius_px; ++i)
      distance_weight[i] = integerWeight(i / kDistanceScale_px);
    for (std::size_t k = 0; k < kRays.size(); ++k)
      sources_[k] = {.disparity = disparity_.data,
                     .disparity_stride = static_cast<std::int32_t>(disparity_.stride),
                     .right_disparity = in_.right_disparity.data,
                     .right_stride = static_cast<std::int32_t>(in_.right_disparity.stride),
                     .guide = in_.guide.data,
                     .guide_stride = static_cast<std::int32_t>(in_.guide.stride),
                     .channels = in_.guide.channels,
                     .width = disparity_.width,
                     .visibility_tolerance_px = kVisibilityTolerance_px,
                     .color_weight = color_weight,
                     .distance_weight = distance_weight,
                     .dx = kRays[k].dx,
                     .dy = kRays[k].dy};
  }

  // Where every candidate is impossible: the background of the row, or of all directions. NaN without any.
  float leastImpossible(int hole) const {
    const HoleRays::Pixel p = rays_.holes()[hole];
    float row = kNan, all = kNan;
    for (std::size_t k = 0; k < kRays.size(); ++k) {
      const int steps = rays_.steps(k)[hole];
      if (steps == HoleRays::kNoSource) continue;
      const float e = disparity_.at(p.y + kRays[k].dy * steps, p.x + kRays[k].dx * steps);
      all = smaller(all, e);
      if (k < kRowRays) row = smaller(row, e);
    }
    return std::isnan(row) ? all : row;
  }

  bool fillHole(int hole, float value) {
    const HoleRays::Pixel p = rays_.holes()[hole];
    std::uint8_t& state = state_.at(p.y, p.x);
    disparity_.at(p.y, p.x) = value;
    if (std::isnan(value)) return false;
    state = filledState(state);
    return true;
  }

  const HoleFillInput& in_;
  ImageView<float> disparity_;
  ImageView<std::uint8_t> state_;
  const HoleRays& rays_;
  const PyramidKernels& kernels_;
  std::array<CandidateSources, kRays.size()> sources_;
};

// A row or column of the map.
struct Line {
  float* disparity;
  std::ptrdiff_t disparity_stride;
  std::uint8_t* state;
  std::ptrdiff_t state_stride;
  int length;

  float& value(int i) const { return disparity[i * disparity_stride]; }
  std::uint8_t& stateAt(int i) const { return state[i * state_stride]; }
  bool isMasked(int i) const { return static_cast<PixelState>(stateAt(i)) == PixelState::kMasked; }
  bool hasValue(int i) const { return !isMasked(i) && !std::isnan(value(i)); }
  void fill(int i, float value_px) const {
    value(i) = value_px;
    stateAt(i) = filledState(stateAt(i));
  }
};

// Between two values, and outside the outermost, every pixel takes the nearer one. False if there is none to
// take.
bool extendNearest(const Line& line) {
  bool complete = true;
  int before = -1;
  for (int after = 0; after <= line.length; ++after) {
    if (after < line.length && !line.hasValue(after)) continue;
    const float left = before >= 0 ? line.value(before) : kNan;
    const float right = after < line.length ? line.value(after) : kNan;
    for (int i = before + 1; i < after; ++i) {
      if (line.isMasked(i)) continue;
      const int to_left = before >= 0 ? i - before : line.length;
      const int to_right = after < line.length ? after - i : line.length;
      const float value = to_left == to_right ? smaller(left, right) : to_left < to_right ? left : right;
      complete &= !std::isnan(value);
      if (!std::isnan(value)) line.fill(i, value);
    }
    before = after;
  }
  return complete;
}

void fillDistant(ImageView<float> disparity, ImageView<std::uint8_t> state, float fallback_disparity,
                 int threads) {
  std::atomic<bool> complete{true};
  parallelStrips(threads, disparity.height, kMinLinesPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      if (!extendNearest({disparity.row(y), 1, state.row(y), 1, disparity.width})) complete = false;
  });
  if (complete) return;
  parallelStrips(threads, disparity.width, kMinLinesPerStrip, [&](int begin, int end) {
    for (int x = begin; x < end; ++x) {
      const Line column{disparity.data + x, disparity.stride, state.data + x, state.stride, disparity.height};
      if (extendNearest(column)) continue;
      for (int y = 0; y < column.length; ++y)
        if (!column.isMasked(y)) column.fill(y, fallback_disparity);  // all of it: the column has no value
    }
  });
}

}  // namespace

void fillHoles(const HoleFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
               Arena& scratch, const PyramidKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  HoleRays rays;
  rays.findHoles(disparity, state, scratch, kernels, threads);
  if (rays.count() == 0) return;
  rays.follow(in.search_radius_px, kernels, threads);
  HoleFiller filler(in, disparity, state, rays, scratch, kernels);
  const auto all = [&](int count, int min_per_strip, auto&& fill) {
    std::atomic<bool> complete{true};
    parallelStrips(threads, count, min_per_strip, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        if (!fill(i)) complete = false;
    });
    return complete.load();
  };
  if (all(filler.batches(), kMinBatchesPerStrip, [&](int batch) { return filler.fillBatch(batch); })) return;
  const ImageView<const float> coarse = in.coarse();
  const auto from_coarse = [&](int hole) { return filler.fillFromCoarse(hole, coarse); };
  if (!coarse.empty() && all(rays.count(), kMinBatchesPerStrip * kHoleBatch, from_coarse)) return;
  fillDistant(disparity, state, in.fallback_disparity, threads);
}

}  // namespace pomona
