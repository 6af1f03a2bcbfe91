// Colour differences between rows of pixels, what there is to fill and to fill from, points near a plane, and
// faint texture.

namespace pomona {
namespace {

void difference1(const std::uint8_t* a, const std::uint8_t* b, int n, std::uint8_t* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] = static_cast<std::uint8_t>(absoluteDifference(a[i], b[i]));
}

void largestDifference3(const std::uint8_t* a, const std::uint8_t* b, int n, std::uint8_t* __restrict out) {
  for (int i = 0; i < n; ++i) {
    const int d0 = absoluteDifference(a[3 * i], b[3 * i]);
    const int d1 = absoluteDifference(a[3 * i + 1], b[3 * i + 1]);
    const int d2 = absoluteDifference(a[3 * i + 2], b[3 * i + 2]);
    const int larger = d0 > d1 ? d0 : d1;
    out[i] = static_cast<std::uint8_t>(larger > d2 ? larger : d2);
  }
}

void countSourcesAndHoles(const float* disparity, const std::uint8_t* state, HoleStates states, int n,
                          std::uint16_t* __restrict sums) {
  for (int i = 0; i < n; ++i) {
    const int known = disparity[i] == disparity[i];
    const int is_measured = state[i] == states.measured;
    const int is_missing = (state[i] >= states.missing) & (state[i] != states.masked);
    const int is_hole = (is_measured & (known ^ 1)) | is_missing;
    sums[i] = static_cast<std::uint16_t>(sums[i] + (is_measured & known) + 256 * is_hole);
  }
}

int countNearPlane(const float* x, const float* y, const float* d, int n, float a, float b, float c,
                   float tolerance) {
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const float error = ((a * x[i] + b * y[i]) + c) - d[i];
    count += (error < tolerance) & (error > -tolerance);
  }
  return count;
}

void localResidual(const std::uint8_t* const rows[5], int n, int most, std::int8_t* __restrict out) {
  const auto limit = static_cast<std::int16_t>(most);
  constexpr int kChunk = 256;
  std::uint16_t sums[kChunk + 4];  // of columns, from two before the chunk to two behind it
  const std::uint8_t *r0 = rows[0], *r1 = rows[1], *r2 = rows[2], *r3 = rows[3], *r4 = rows[4];
  const auto sumOf = [=](int x) { return static_cast<std::uint16_t>(r0[x] + r1[x] + r2[x] + r3[x] + r4[x]); };
  for (int begin = 0; begin < n; begin += kChunk) {
    const int count = n - begin < kChunk ? n - begin : kChunk;
    for (int i = 0; i < count; ++i) sums[i + 2] = sumOf(begin + i);
    for (int i = 1; i <= 2; ++i) {
      sums[2 - i] = sumOf(begin - i > 0 ? begin - i : 0);
      sums[count + 1 + i] = sumOf(begin + count - 1 + i < n - 1 ? begin + count - 1 + i : n - 1);
    }
    for (int i = 0; i < count; ++i) {
      const auto sum =
          static_cast<std::int16_t>(sums[i] + sums[i + 1] + sums[i + 2] + sums[i + 3] + sums[i + 4]);
      const auto residual = static_cast<std::int16_t>(25 * r2[begin + i] - sum);
      const bool is_faint = (residual <= limit) & (residual >= -limit);
      out[begin + i] = static_cast<std::int8_t>(is_faint ? residual : 0);
    }
  }
}

// Four at a time: their sums still fit 16 bits.
void correlate(const std::int8_t* left, const std::int8_t* right, int n, int places,
               std::int32_t* __restrict products, std::int32_t* __restrict squares) {
  constexpr int kGroup = 4;
  for (int begin = 0; begin < n; begin += kGroup) {
    std::int16_t a[kGroup], counts[kGroup];
    const std::int8_t* b[kGroup];
    for (int i = 0; i < kGroup; ++i) {
      const bool is_there = begin + i < n;
      a[i] = is_there ? left[begin + i] : std::int8_t{0};
      counts[i] = a[i] != 0;
      b[i] = right + (is_there ? begin + i : begin);
    }
    if (counts[0] + counts[1] + counts[2] + counts[3] == 0) continue;
    for (int k = 0; k < places; ++k) {
      const std::int16_t b0 = b[0][k], b1 = b[1][k], b2 = b[2][k], b3 = b[3][k];
      products[k] += static_cast<std::int16_t>(a[0] * b0 + a[1] * b1 + a[2] * b2 + a[3] * b3);
      squares[k] += static_cast<std::int16_t>(counts[0] * b0 * b0 + counts[1] * b1 * b1 +
                                              counts[2] * b2 * b2 + counts[3] * b3 * b3);
    }
  }
}

}  // namespace
}  // namespace pomona
