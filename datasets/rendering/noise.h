// Value noise.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "datasets/hash.h"

namespace pomona {

/// Random values on the integer lattice, blended by 3t^2 - 2t^3 along each axis: 0..1.
inline double valueNoise(const cv::Vec3d& p, std::uint64_t seed) {
  std::array<std::array<std::uint64_t, 2>, 3> corner;
  std::array<double, 3> t;
  constexpr std::array<std::uint64_t, 3> kStep = {0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu,
                                                  0x165667b19e3779f9u};
  for (int axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(p[axis]);
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(floor));
    corner[axis] = {cell * kStep[axis], (cell + 1) * kStep[axis]};
    const double f = p[axis] - floor;
    t[axis] = f * f * (3 - 2 * f);
  }
  const auto alongX = [&](int y, int z) {
    const std::uint64_t base = seed + corner[1][y] + corner[2][z];
    const double a = unitInterval(hash(base + corner[0][0])), b = unitInterval(hash(base + corner[0][1]));
    return a + t[0] * (b - a);
  };
  const auto alongY = [&](int z) { return alongX(0, z) + t[1] * (alongX(1, z) - alongX(0, z)); };
  return alongY(0) + t[2] * (alongY(1) - alongY(0));
}

}  // namespace pomona
