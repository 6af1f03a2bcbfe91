#include "pyramid/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMinRowsPerStrip = 8;

// The pixels of the input that one pixel of the output covers, in exact arithmetic: the first one with weight
// `first_weight`, the last of `count` with `last_weight`, those between with the ratio's denominator.
struct AreaSpan {
  int first, count;
  std::uint32_t first_weight, last_weight;
};

// One axis of area averaging. In units of 1 / out of an input pixel, input pixels are `out` long and output
// pixels `in` long, so that every overlap is an integer; dividing by the common divisor keeps the integers
// small.
struct AreaAxis {
  AreaAxis(int in_length, int out_length)
      : in(in_length / std::gcd(in_length, out_length)), out(out_length / std::gcd(in_length, out_length)) {}

  AreaSpan span(int position) const {
    const std::int64_t begin = std::int64_t{position} * in, end = begin + in;
    const std::int64_t first = begin / out, last = (end - 1) / out;
    const std::int64_t first_weight = std::min((first + 1) * out, end) - begin;
    return {static_cast<int>(first), static_cast<int>(last - first + 1),
            static_cast<std::uint32_t>(first_weight),
            static_cast<std::uint32_t>(end - std::max(last * out, begin))};
  }
  bool isWhole(int factor) const { return in == factor && out == 1; }
  std::uint32_t weight(const AreaSpan& span, int i) const {
    return i == 0                ? span.first_weight
           : i == span.count - 1 ? span.last_weight
                                 : static_cast<std::uint32_t>(out);
  }

  int in, out;
};

template <typename T>
struct Interleaved {
  const T* data;
  int width, height, channels;
  std::ptrdiff_t stride;
};

// The second half: columns are already summed over the output row's height.
template <typename T>
void averageAlongRow(const std::uint32_t* sums, const AreaAxis& axis, const AreaSpan* spans, int out_w,
                     int channels, std::uint64_t area, T* out) {
  for (int x = 0; x < out_w; ++x) {
    const AreaSpan& span = spans[x];
    for (int c = 0; c < channels; ++c) {
      const std::uint32_t* p = sums + span.first * channels + c;
      std::uint64_t inner = 0;
      for (int i = 1; i < span.count - 1; ++i) inner += p[i * channels];
      std::uint64_t sum =
          std::uint64_t{span.first_weight} * p[0] + inner * static_cast<std::uint64_t>(axis.out);
      if (span.count > 1) sum += std::uint64_t{span.last_weight} * p[(span.count - 1) * channels];
      const std::uint64_t doubled = 2 * sum + area;
      // Dividing 32 bits takes half the time of 64.
      out[x * channels + c] = static_cast<T>(doubled <= UINT32_MAX ? static_cast<std::uint32_t>(doubled) /
                                                                         static_cast<std::uint32_t>(2 * area)
                                                                   : doubled / (2 * area));
    }
  }
}

// The same for blocks of kSide x kSide whole pixels: of a known number, shifts take the place of divisions.
template <int kSide, typename T>
void averageBlocks(const std::uint32_t* sums, int out_w, int channels, T* out) {
  constexpr std::uint32_t kArea = kSide * kSide;
  for (int x = 0; x < out_w; ++x, sums += kSide * channels)
    for (int c = 0; c < channels; ++c) {
      std::uint32_t sum = 0;
      for (int i = 0; i < kSide; ++i) sum += sums[i * channels + c];
      *out++ = static_cast<T>((2 * sum + kArea) / (2 * kArea));
    }
}

template <typename T, typename Accumulate>
void averageAreas(const Interleaved<T>& in, ImageView<T> out, Arena& scratch, Accumulate accumulate,
                  int threads) {
  const int out_w = out.width / in.channels, out_h = out.height;
  const AreaAxis across(in.width, out_w), down(in.height, out_h);
  const int row_values = in.width * in.channels;
  const Arena::Scope scope(scratch);
  const auto column_sums = scratch.image<std::uint32_t>(row_values, out_h);
  AreaSpan* const spans = scratch.take<AreaSpan>(static_cast<std::size_t>(out_w));
  for (int x = 0; x < out_w; ++x) spans[x] = across.span(x);
  const std::uint64_t area = static_cast<std::uint64_t>(across.in) * static_cast<std::uint64_t>(down.in);
  parallelStrips(threads, out_h, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint32_t* sums = column_sums.row(y);
      std::fill_n(sums, row_values, 0u);
      const AreaSpan span = down.span(y);
      for (int i = 0; i < span.count; ++i)
        accumulate(in.data + (span.first + i) * in.stride, down.weight(span, i), row_values, sums);
      if (across.isWhole(4) && down.isWhole(4))  // most often, as colour segments are found at 1/4
        averageBlocks<4>(sums, out_w, in.channels, out.row(y));
      else
        averageAlongRow(sums, across, spans, out_w, in.channels, area, out.row(y));
    }
  });
}

// Keys 1981, Eq. 15: the kernel at distance s, for a = -1/2.
double keys(double s) {
  s = std::abs(s);
  if (s < 1) return (1.5 * s - 2.5) * s * s + 1;
  return s < 2 ? ((-0.5 * s + 2.5) * s - 4) * s + 2 : 0;
}

// The four samples and weights behind each output sample of a cubic convolution; tap k of sample x is at
// k n + x.
struct CubicTaps {
  std::int32_t* index;
  float* weight;
};

// Output centre x lies at (x + 1/2) in / out - 1/2 of the input: computed exactly, in units of 1 / (2 out).
CubicTaps makeTaps(int in, int out, Arena& arena) {
  const std::size_t n = static_cast<std::size_t>(out);
  const CubicTaps taps{arena.take<std::int32_t>(4 * n), arena.take<float>(4 * n)};
  for (std::size_t x = 0; x < n; ++x) {
    const std::int64_t unit = 2 * std::int64_t{out};
    const std::int64_t position = (2 * static_cast<std::int64_t>(x) + 1) * in - out;
    const std::int64_t whole = (position + unit) / unit - 1;  // floor: position >= -unit
    const double fraction = static_cast<double>(position - whole * unit) / static_cast<double>(unit);
    for (int k = 0; k < 4; ++k) {
      const std::size_t tap = static_cast<std::size_t>(k) * n + x;
      taps.index[tap] = static_cast<std::int32_t>(std::clamp<std::int64_t>(whole + k - 1, 0, in - 1));
      taps.weight[tap] = static_cast<float>(keys(fraction - (k - 1)));
    }
  }
  return taps;
}

float meanOfKnownTaps(ImageView<const float> in, const std::int32_t row[4], const float row_weight[4],
                      const CubicTaps& columns, std::size_t n, std::size_t x) {
  float sum = 0, total = 0;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < 4; ++k) {
      const float value = in.at(row[j], columns.index[k * n + x]);
      if (std::isnan(value)) continue;
      const float weight = std::abs(row_weight[j] * columns.weight[k * n + x]);
      sum += weight * value;
      total += weight;
    }
  return total > 0 ? sum / total : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

int scaledLength(int length, int factor) {
  return std::max(1, (length + factor - 1) / factor);
}

void areaDownscale(GuideView in, ImageView<std::uint8_t> out, Arena& scratch, const PyramidKernels& kernels,
                   int threads) {
  averageAreas<std::uint8_t>({in.data, in.width, in.height, in.channels, in.stride}, out, scratch,
                             kernels.accumulate8, threads);
}

void areaDownscale(ImageView<const std::uint16_t> in, ImageView<std::uint16_t> out, Arena& scratch,
                   const PyramidKernels& kernels, int threads) {
  averageAreas<std::uint16_t>({in.data, in.width, in.height, 1, in.stride}, out, scratch,
                              kernels.accumulate16, threads);
}

void bicubicUpscale(ImageView<const float> in, ImageView<float> out, Arena& scratch,
                    const PyramidKernels& kernels, int threads) {
  const Arena::Scope scope(scratch);
  const CubicTaps columns = makeTaps(in.width, out.width, scratch);
  const CubicTaps taps = makeTaps(in.height, out.height, scratch);
  const auto widened = scratch.image<float>(out.width, in.height);
  bool* const row_has_nan = scratch.take<bool>(static_cast<std::size_t>(in.height));
  parallelStrips(threads, in.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* row = in.row(y);
      kernels.cubicRow(row, columns.index, columns.weight, out.width, widened.row(y));
      row_has_nan[y] = std::any_of(row, row + in.width, [](float v) { return std::isnan(v); });
    }
  });
  parallelStrips(threads, out.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::int32_t index[4];
      float weight[4];
      const float* rows[4];
      bool has_nan = false;
      for (int k = 0; k < 4; ++k) {
        const std::size_t tap =
            static_cast<std::size_t>(k) * static_cast<std::size_t>(out.height) + static_cast<std::size_t>(y);
        index[k] = taps.index[tap];
        weight[k] = taps.weight[tap];
        rows[k] = widened.row(index[k]);
        has_nan |= row_has_nan[index[k]];
      }
      float* o = out.row(y);
      kernels.cubicColumn(rows, weight, out.width, o);
      if (!has_nan) continue;
      const std::size_t n = static_cast<std::size_t>(out.width);
      for (std::size_t x = 0; x < n; ++x)  // a single absent tap has made the sum NaN
        if (std::isnan(o[x])) o[x] = meanOfKnownTaps(in, index, weight, columns, n, x);
    }
  });
}

void scaleDisparity(ImageView<float> disparity, float ratio, int threads) {
  parallelStrips(threads, disparity.height, kMinRowsPerStrip, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* row = disparity.row(y);
      for (int x = 0; x < disparity.width; ++x) row[x] *= ratio;
    }
  });
}

}  // namespace pomona
