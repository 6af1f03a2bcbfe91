// Colour differences between rows of pixels, what there is to fill and to fill from, points near a plane, and
// faint texture.

namespace pomona {
namespace {

inline int absoluteDifference(int a, int b) {
  return a > b ? a - b : b - a;
}

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

void countSourcesAndHoles(const float* disparity, const std::uint8_t* state, std::uint8_t measured,
                          std::uint8_t missing, std::uint8_t masked, int n, std::uint16_t* __restrict sums) {
  for (int i = 0; i < n; ++i) {
    const int known = disparity[i] == disparity[i];
    const int is_measured = state[i] == measured;
    const int is_missing = (state[i] >= missing) & (state[i] != masked);
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

void localResidual(const std::uint8_t* const rows[5], int n, int limit, std::int8_t* __restrict out) {
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
      const int sum = sums[i] + sums[i + 1] + sums[i + 2] + sums[i + 3] + sums[i + 4];
      const int residual = 25 * r2[begin + i] - sum;
      const bool is_faint = (residual <= limit) & (residual >= -limit);
      out[begin + i] = static_cast<std::int8_t>(is_faint ? residual : 0);
    }
  }
}

void correlate(const std::int8_t* left, const std::int8_t* right, int n, int disparities,
               std::int32_t* __restrict products, std::int32_t* __restrict squares) {
  for (int i = 0; i < n; ++i) {
    const std::int16_t a = left[i];
    if (a == 0) continue;
    const std::int8_t* b = right - i;
    for (int d = 0; d < disparities; ++d) {
      products[d] += static_cast<std::int16_t>(a * b[d]);
      squares[d] += static_cast<std::int16_t>(b[d] * b[d]);
    }
  }
}

}  // namespace
}  // namespace pomona
