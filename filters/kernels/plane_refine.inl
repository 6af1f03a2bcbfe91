// Least-squares planes through the neighbours that look like a pixel, one vector of pixels at a time.
#pragma once

namespace pomona {
namespace {

/// Sums over the neighbours taken, (x, y) their place and z their disparity, all relative to the pixel's own.
struct PlaneMoments {
  Floats n = {}, x = {}, y = {}, z = {}, xx = {}, xy = {}, yy = {}, xz = {}, yz = {};
};

/// The window row `dy` below the pixels at column `x`.
template <int kRadius>
inline void addWindowRow(const GuidedRow& row, int x, int dy, Floats centre, Ints centre_color,
                         PlaneMoments& m) {
  const float* disparity = row.disparity + dy * row.stride + x;
  const std::uint32_t* color = row.color + dy * row.stride + x;
  Floats n = {}, sum_x = {}, xx = {}, z = {}, xz = {};
#pragma GCC unroll 8
  for (int dx = -kRadius; dx <= kRadius; ++dx) {
    const float step = static_cast<float>(dx);
    const Floats dz = load(disparity + dx) - centre;
    const Ints alike =
        allChannelsBelow(absoluteDifference(loadColors(color + dx), centre_color), kPlaneColorTolerance);
    const Ints taken = (max(dz, -dz) < kPlaneDisparityTolerance_px) & alike;
    const Floats one = taken ? broadcast(1.0f) : Floats{};
    const Floats value = taken ? dz : Floats{};
    n += one;
    z += value;
    sum_x += one * step;
    xx += one * (step * step);
    xz += value * step;
  }
  const float step = static_cast<float>(dy);
  m.n += n;
  m.x += sum_x;
  m.y += n * step;
  m.z += z;
  m.xx += xx;
  m.xy += sum_x * step;
  m.yy += n * (step * step);
  m.xz += xz;
  m.yz += z * step;
}

/// The plane's value at the origin, by the normal equations of the centred moments.
inline Floats planeAtOrigin(const PlaneMoments& m) {
  const Floats x = m.x / m.n, y = m.y / m.n, z = m.z / m.n;
  const Floats xx = m.xx / m.n - x * x + kPlaneRidge;
  const Floats xy = m.xy / m.n - x * y;
  const Floats yy = m.yy / m.n - y * y + kPlaneRidge;
  const Floats xz = m.xz / m.n - x * z;
  const Floats yz = m.yz / m.n - y * z;
  const Floats slope_x = xz * yy - yz * xy, slope_y = yz * xx - xz * xy;  // times the determinant
  return z - (slope_x * x + slope_y * y) / (xx * yy - xy * xy);
}

template <int kRadius>
void refinePlanesRow(const GuidedRow& row, int width, float* out) {
  for (int x = 0; x < width; x += kFloatLanes) {
    const Floats centre = load(row.disparity + x);
    const Ints color = loadColors(row.color + x);
    PlaneMoments m;
    for (int dy = -kRadius; dy <= kRadius; ++dy) addWindowRow<kRadius>(row, x, dy, centre, color, m);
    const Floats fitted = centre + planeAtOrigin(m);
    storeFirst(out + x, m.n >= kPlaneFewestTaps ? fitted : centre, width - x);
  }
}

}  // namespace
}  // namespace pomona
