// Colour differences between rows of pixels, what there is to fill and to fill from, points near a plane.

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

}  // namespace
}  // namespace pomona
