#include "pyramid/hole_fill.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {
namespace {

constexpr std::size_t kRowRays = 2;  // kRays[0] and [1]
constexpr double kColorScale = 12;
constexpr double kDistanceScale_px = 30;
constexpr float kVisibilityTolerance_px = 1.5f;
constexpr int kMinHolesPerStrip = 512;
constexpr int kMinLinesPerStrip = 16;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::uint32_t integerWeight(double exponent) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(std::ldexp(std::exp(-exponent), 28))));
}

// std::min, but NaN counts as absent.
float smaller(float a, float b) {
  return std::isnan(a) || b < a ? b : a;
}

struct Candidate {
  float disparity;
  std::uint64_t weight;
};

// The possible candidates of one hole, kept in ascending order, and what to fall back on.
struct Candidates {
  std::array<Candidate, kRays.size()> sorted;
  int count = 0;
  std::uint64_t total_weight = 0;
  float row_background = kNan;
  float smallest = kNan;

  void insert(Candidate c) {
    int i = count++;
    for (; i > 0 && c.disparity < sorted[static_cast<std::size_t>(i - 1)].disparity; --i)
      sorted[static_cast<std::size_t>(i)] = sorted[static_cast<std::size_t>(i - 1)];
    sorted[static_cast<std::size_t>(i)] = c;
    total_weight += c.weight;
  }
  // The first whose weight together with all before reaches `quarters` of four parts of the total.
  float quantile(std::uint64_t quarters) const {
    std::uint64_t sum = 0;
    std::size_t i = 0;
    while (4 * (sum += sorted[i].weight) < quarters * total_weight) ++i;
    return sorted[i].disparity;
  }
};

class HoleFiller {
 public:
  HoleFiller(const HoleFillInput& in, ImageView<float> disparity, ImageView<std::uint8_t> state,
             HoleFillScratch& scratch)
      : in_(in),
        disparity_(disparity),
        state_(state),
        rays_(scratch.rays),
        color_weight_(scratch.color_weight),
        distance_weight_(scratch.distance_weight),
        most_steps_(std::max(disparity.width, disparity.height)) {
    const int channels = in.guide.channels;
    color_weight_.resize(3 * 255 + 1);
    for (int i = 0; i <= 255 * channels; ++i)
      color_weight_[static_cast<std::size_t>(i)] = integerWeight(i / (channels * kColorScale));
    distance_weight_.resize(3 * static_cast<std::size_t>(most_steps_));
    const int longest = std::min(most_steps_ - 1, in.search_radius_px);
    for (int squared_step : {1, 2, 5})
      for (int i = 0; i <= longest; ++i)
        distance_weight_[distanceIndex(squared_step, i)] =
            integerWeight(i * std::sqrt(static_cast<double>(squared_step)) / kDistanceScale_px);
  }

  // Writes holes only and reads disparities at sources only: holes may be filled in any order. False, and
  // NaN, if no source is within reach.
  bool fill(int hole) {
    const HoleRays::Pixel p = rays_.holes()[hole];
    const Candidates candidates = collect(hole, p);
    std::uint8_t& state = state_.at(p.y, p.x);
    float& disparity = disparity_.at(p.y, p.x);
    const bool background = isBackground(state);
    if (candidates.count > 0)
      disparity = candidates.quantile(background ? 1 : 2);
    else
      disparity = std::isnan(candidates.row_background) ? candidates.smallest : candidates.row_background;
    if (std::isnan(disparity)) return false;
    state = filledState(state);
    return true;
  }

  // For a hole that fill() left open.
  bool fillFromCoarse(int hole, ImageView<const float> coarse) {
    const HoleRays::Pixel p = rays_.holes()[hole];
    float& disparity = disparity_.at(p.y, p.x);
    if (!std::isnan(disparity)) return true;
    disparity = coarse.at(p.y, p.x);
    if (std::isnan(disparity)) return false;
    state_.at(p.y, p.x) = static_cast<std::uint8_t>(PixelState::kFilledCoarse);
    return true;
  }

  static bool isBackground(std::uint8_t state) {
    const PixelState s = static_cast<PixelState>(state);
    return s == PixelState::kOccluded || s == PixelState::kOutOfRange;
  }
  static std::uint8_t filledState(std::uint8_t state) {
    return static_cast<std::uint8_t>(isBackground(state) ? PixelState::kFilledBackground
                                                         : PixelState::kFilledInterpolated);
  }

 private:
  std::size_t distanceIndex(int squared_step, int steps) const {  // 1, 2, 5: table 0, 1, 2
    return static_cast<std::size_t>(squared_step / 2 * most_steps_ + steps);
  }

  Candidates collect(int hole, HoleRays::Pixel p) const {
    Candidates result;
    for (std::size_t k = 0; k < kRays.size(); ++k) {
      const std::uint16_t steps = rays_.steps(k)[hole];
      if (steps == HoleRays::kNoSource) continue;
      const int x = p.x + kRays[k].dx * steps, y = p.y + kRays[k].dy * steps;
      const float e = disparity_.at(y, x);
      result.smallest = smaller(result.smallest, e);
      if (k < kRowRays) result.row_background = smaller(result.row_background, e);
      if (!isPossible(p, e)) continue;
      const std::uint64_t distance_weight = distance_weight_[distanceIndex(kRays[k].squaredStep(), steps)];
      result.insert({e, distance_weight * color_weight_[colorDifference(p, x, y)]});
    }
    return result;
  }

  bool isPossible(HoleRays::Pixel p, float e) const {
    const float x_right = std::floor(static_cast<float>(p.x) - e + 0.5f);
    if (!(x_right >= 0 && x_right < static_cast<float>(in_.right_disparity.width))) return true;
    const float seen = in_.right_disparity.at(p.y, static_cast<int>(x_right));
    return !(seen < e - kVisibilityTolerance_px);
  }

  std::size_t colorDifference(HoleRays::Pixel p, int x, int y) const {
    const int channels = in_.guide.channels;
    const std::uint8_t* a = in_.guide.row(p.y) + p.x * channels;
    const std::uint8_t* b = in_.guide.row(y) + x * channels;
    int sum = 0;
    for (int c = 0; c < channels; ++c) sum += std::abs(a[c] - b[c]);
    return static_cast<std::size_t>(sum);
  }

  const HoleFillInput& in_;
  ImageView<float> disparity_;
  ImageView<std::uint8_t> state_;
  const HoleRays& rays_;
  Buffer<std::uint32_t>& color_weight_;
  Buffer<std::uint32_t>& distance_weight_;
  int most_steps_;
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
    stateAt(i) = HoleFiller::filledState(stateAt(i));
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
               HoleFillScratch& scratch, const PyramidKernels& kernels, int threads) {
  scratch.rays.findHoles(disparity, state, threads);
  if (scratch.rays.count() == 0) return;
  scratch.rays.follow(in.search_radius_px, kernels, threads);
  HoleFiller filler(in, disparity, state, scratch);
  const auto forEachHole = [&](auto&& fill) {
    std::atomic<bool> complete{true};
    parallelStrips(threads, scratch.rays.count(), kMinHolesPerStrip, [&](int begin, int end) {
      for (int hole = begin; hole < end; ++hole)
        if (!fill(hole)) complete = false;
    });
    return complete.load();
  };
  if (forEachHole([&](int hole) { return filler.fill(hole); })) return;
  const ImageView<const float> coarse = in.coarse();
  if (!coarse.empty() && forEachHole([&](int hole) { return filler.fillFromCoarse(hole, coarse); })) return;
  fillDistant(disparity, state, in.fallback_disparity, threads);
}

}  // namespace pomona
