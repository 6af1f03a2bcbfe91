// Rows of area averaging and of cubic convolution.

namespace pomona {
namespace {

template <typename T>
void accumulate(const T* in, std::uint32_t weight, int n, std::uint32_t* __restrict sum) {
  for (int i = 0; i < n; ++i) sum[i] += weight * in[i];
}

void cubicRow(const float* in, const std::int32_t* index, const float* weight, int n, float* __restrict out) {
  const std::int32_t *i0 = index, *i1 = i0 + n, *i2 = i1 + n, *i3 = i2 + n;
  const float *w0 = weight, *w1 = w0 + n, *w2 = w1 + n, *w3 = w2 + n;
  for (int x = 0; x < n; ++x)
    out[x] = (w0[x] * in[i0[x]] + w1[x] * in[i1[x]]) + (w2[x] * in[i2[x]] + w3[x] * in[i3[x]]);
}

void cubicColumn(const float* const rows[4], const float weight[4], int n, float* __restrict out) {
  const float *r0 = rows[0], *r1 = rows[1], *r2 = rows[2], *r3 = rows[3];
  const float w0 = weight[0], w1 = weight[1], w2 = weight[2], w3 = weight[3];
  for (int x = 0; x < n; ++x) out[x] = (w0 * r0[x] + w1 * r1[x]) + (w2 * r2[x] + w3 * r3[x]);
}

}  // namespace
}  // namespace pomona
