// Distances as they were measured, beside the true ones.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace pomona {

inline constexpr double kNoDistance = std::numeric_limits<double>::quiet_NaN();

struct MeasuredDistance {
  double true_m = kNoDistance;
  double measured_m = kNoDistance;  ///< NaN: not measured
  double sigma_m = kNoDistance;     ///< standard deviation that the measurement claims; NaN: none
};

/// Errors of the measured ones; NaN where none was. Percent are of the true distance.
struct DistanceErrors {
  int all = 0, measured = 0;
  double mean_mm = kNoDistance, rms_mm = kNoDistance, median_mm = kNoDistance;
  double mean_percent = kNoDistance, median_percent = kNoDistance, p95_percent = kNoDistance;
  double within_2_sigma_percent = kNoDistance;  ///< of those that claim a standard deviation
};
DistanceErrors errorsOf(std::span<const MeasuredDistance> distances);

/// Entry floor(q n) of the n sorted values, q in [0, 1); NaN without values.
double quantile(std::vector<double> values, double q);

}  // namespace pomona
