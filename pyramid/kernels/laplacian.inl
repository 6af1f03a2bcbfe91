// Rows of Burt & Adelson's REDUCE and EXPAND, and of averaging two pyramids.

namespace pomona {
namespace {

inline float binomial5(float a, float b, float c, float d, float e) {
  return ((a + e) + 4.0f * (b + d) + 6.0f * c) * 0.0625f;
}

inline float reduceAtBorder(const float* in, int n, int x) {
  const auto at = [&](int i) { return in[i < 0 ? 0 : i >= n ? n - 1 : i]; };
  return binomial5(at(2 * x - 2), at(2 * x - 1), at(2 * x), at(2 * x + 1), at(2 * x + 2));
}

void reduceRow(const float* in, int n, float* __restrict out) {
  const int reduced = (n + 1) / 2;
  if (reduced > 0) out[0] = reduceAtBorder(in, n, 0);
  for (int x = 1; x < reduced - 1; ++x)
    out[x] = binomial5(in[2 * x - 2], in[2 * x - 1], in[2 * x], in[2 * x + 1], in[2 * x + 2]);
  if (reduced > 1) out[reduced - 1] = reduceAtBorder(in, n, reduced - 1);
}

void reduceColumn(const float* const rows[5], int n, float* __restrict out) {
  const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
  for (int x = 0; x < n; ++x) out[x] = binomial5(a[x], b[x], c[x], d[x], e[x]);
}

inline float expandEven(float before, float at, float after) {
  return 0.125f * (before + after) + 0.75f * at;
}
inline float expandOdd(float before, float after) {
  return 0.5f * (before + after);
}

void expandRow(const float* in, int n, float* __restrict out) {
  const int last = (n + 1) / 2 - 1;
  if (last < 0) return;
  out[0] = expandEven(in[0], in[0], in[last > 0]);
  if (n > 1) out[1] = expandOdd(in[0], in[last > 0]);
  for (int i = 1; i < last; ++i) {
    out[2 * i] = expandEven(in[i - 1], in[i], in[i + 1]);
    out[2 * i + 1] = expandOdd(in[i], in[i + 1]);
  }
  if (last == 0) return;
  out[2 * last] = expandEven(in[last - 1], in[last], in[last]);
  if (2 * last + 1 < n) out[2 * last + 1] = in[last];
}

void addExpandedColumn(const float* above, const float* middle, const float* below, float side_weight,
                       float middle_weight, int n, float* __restrict inout) {
  for (int x = 0; x < n; ++x) inout[x] += side_weight * (above[x] + below[x]) + middle_weight * middle[x];
}

void average(const float* other, int n, float* __restrict inout) {
  for (int x = 0; x < n; ++x) inout[x] = 0.5f * (inout[x] + other[x]);
}

}  // namespace
}  // namespace pomona
