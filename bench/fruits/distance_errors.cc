#include "bench/fruits/distance_errors.h"

#include <algorithm>
#include <cmath>

namespace pomona {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return kNoDistance;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

DistanceErrors errorsOf(std::span<const MeasuredDistance> distances) {
  constexpr double kMmPerM = 1000;
  DistanceErrors out;
  out.all = static_cast<int>(distances.size());
  std::vector<double> mm, percent;
  double sum_mm = 0, squares_mm2 = 0, sum_percent = 0;
  int claims = 0, kept = 0;
  for (const MeasuredDistance& d : distances) {
    if (std::isnan(d.measured_m)) continue;
    const double error_m = std::abs(d.measured_m - d.true_m);
    mm.push_back(kMmPerM * error_m);
    sum_mm += mm.back();
    squares_mm2 += mm.back() * mm.back();
    percent.push_back(100 * error_m / d.true_m);
    sum_percent += percent.back();
    if (std::isnan(d.sigma_m)) continue;
    ++claims;
    kept += error_m <= 2 * d.sigma_m;
  }
  out.measured = static_cast<int>(percent.size());
  if (out.measured == 0) return out;
  out.mean_mm = sum_mm / out.measured;
  out.rms_mm = std::sqrt(squares_mm2 / out.measured);
  out.median_mm = quantile(mm, 0.5);
  out.mean_percent = sum_percent / out.measured;
  out.median_percent = quantile(percent, 0.5);
  out.p95_percent = quantile(percent, 0.95);
  if (claims > 0) out.within_2_sigma_percent = 100.0 * kept / claims;
  return out;
}

}  // namespace pomona
