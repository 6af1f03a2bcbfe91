// Batches of holes: what their rays offer, and which of it they take. One lane per hole throughout.

namespace pomona {
namespace {

inline int absoluteDifference(int a, int b) {
  return a > b ? a - b : b - a;
}

/// The sums over the channels between the pixels at byte offsets a[i] and b[i]. One at a time on purpose:
/// left to itself, GCC takes vectors of offsets apart, which is slower.
__attribute__((optimize("no-tree-vectorize"))) void channelDifferences(const std::uint8_t* guide,
                                                                       int channels, const std::int32_t* a,
                                                                       const std::int32_t* b, int n,
                                                                       std::int32_t* __restrict out) {
  for (int i = 0; i < n; ++i) {
    out[i] = 0;
    for (int c = 0; c < channels; ++c) out[i] += absoluteDifference(guide[a[i] + c], guide[b[i] + c]);
  }
}

inline Ints absoluteDifference(Ints a, Ints b) {
  return max(a - b, b - a);
}

/// The three bytes at each offset. A fourth is read: the one before them, as the image may end behind them.
inline Ints gatherColors(const std::uint8_t* guide, Ints offset) {
  const Ints has_before = offset > 0;
  return gatherBytes(guide, offset + has_before) >> (has_before & 8) & 0xFFFFFF;
}

/// The same for three channels of more than one pixel; a, b and out have room for whole vectors, of valid
/// offsets.
void colorDifferences(const std::uint8_t* guide, const std::int32_t* a, const std::int32_t* b, int n,
                      std::int32_t* __restrict out) {
  for (int i = 0; i < n; i += kFloatLanes) {
    const Ints p = gatherColors(guide, load(a + i)), q = gatherColors(guide, load(b + i));
    store(out + i, absoluteDifference(p & 255, q & 255) + absoluteDifference(p >> 8 & 255, q >> 8 & 255) +
                       absoluteDifference(p >> 16, q >> 16));
  }
}

void gatherRow(const std::uint32_t* from, const std::int32_t* index, int count,
               std::uint32_t* __restrict out) {
  int i = 0;
  for (; i + kFloatLanes <= count; i += kFloatLanes)
    store(reinterpret_cast<std::int32_t*>(out) + i, gather(from, load(index + i)));
  for (; i < count; ++i) out[i] = from[index[i]];
}

// Masks of all ones or none (-bool) stand where a conditional would keep GCC from vectorising.
void gatherCandidates(const CandidateSources& sources, const std::int32_t* x, const std::int32_t* y,
                      const std::uint16_t* steps, int n, float* __restrict disparity,
                      std::uint32_t* __restrict weight) {
  const CandidateSources s = sources;
  const float width = static_cast<float>(s.width);
  std::int32_t index[kHoleBatch] = {}, count[kHoleBatch] = {}, here[kHoleBatch] = {}, there[kHoleBatch] = {};
  for (int i = 0; i < n; ++i) {  // a ray without a source ends at the hole itself
    count[i] = steps[i] & -static_cast<std::int32_t>(steps[i] != 0xffff);
    const std::int32_t source_x = x[i] + s.dx * count[i], source_y = y[i] + s.dy * count[i];
    index[i] = source_y * s.disparity_stride + source_x;
    here[i] = y[i] * s.guide_stride + x[i] * s.channels;
    there[i] = source_y * s.guide_stride + source_x * s.channels;
  }
  std::int32_t difference[kHoleBatch];
  if (s.channels == 3 && s.width > 1)
    colorDifferences(s.guide, here, there, n, difference);
  else
    channelDifferences(s.guide, s.channels, here, there, n, difference);
  float e[kHoleBatch], seen[kHoleBatch];
  std::uint32_t color_weight[kHoleBatch], distance_weight[kHoleBatch];
  gatherRow(s.disparity, index, n, e);
  gatherRow(s.distance_weight, count, n, distance_weight);

  std::int32_t inside[kHoleBatch];
  for (int i = 0; i < n; ++i) {
    // floor(x - e + 1/2), with everything beyond the image drawn to its very edge so that it fits an integer
    const float place = static_cast<float>(x[i]) - e[i] + 0.5f;
    const float near_place = place > -1.0f ? place : -1.0f;
    const float clamped = near_place < width ? near_place : width;
    const std::int32_t truncated = static_cast<std::int32_t>(clamped);
    const std::int32_t x_right = truncated - (static_cast<float>(truncated) > clamped);
    inside[i] = -static_cast<std::int32_t>((x_right >= 0) & (x_right < s.width));
    index[i] = y[i] * s.right_stride + (x_right & inside[i]);
  }
  gatherRow(s.right_disparity, index, n, seen);
  gatherRow(s.color_weight, difference, n, color_weight);

  for (int i = 0; i < n; ++i) {
    const bool contradicted = (inside[i] != 0) & (seen[i] < e[i] - s.visibility_tolerance_px);
    const bool possible = (steps[i] != 0xffff) & !contradicted;
    const std::uint32_t product = color_weight[i] * distance_weight[i] >> 4;
    disparity[i] = possible ? e[i] : __builtin_inff();
    weight[i] = (product + (product == 0)) & -static_cast<std::uint32_t>(possible);
  }
}

void candidateMedian(const float* disparity, const std::uint32_t* weight, int n, float* __restrict out) {
  std::uint32_t needed[kHoleBatch] = {}, sum[kHoleBatch];
  for (int k = 0; k < kHoleRays; ++k)
    for (int i = 0; i < n; ++i) needed[i] += weight[k * n + i];
  for (int i = 0; i < n; ++i) {
    needed[i] = needed[i] / 2 + needed[i] % 2;
    out[i] = __builtin_inff();
  }
  for (int k = 0; k < kHoleRays; ++k) {
    const float* d = disparity + k * n;
    for (int i = 0; i < n; ++i) sum[i] = 0;
    for (int j = 0; j < kHoleRays; ++j)
      for (int i = 0; i < n; ++i) {
        const std::uint32_t w = weight[j * n + i];
        sum[i] += disparity[j * n + i] <= d[i] ? w : 0;
      }
    for (int i = 0; i < n; ++i) out[i] = (sum[i] >= needed[i]) & (d[i] < out[i]) ? d[i] : out[i];
  }
}

}  // namespace
}  // namespace pomona
