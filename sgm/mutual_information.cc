#include "sgm/mutual_information.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

constexpr int kRadius = 3;
// exp(-k^2 / 2), normalised over -3 .. 3.
constexpr double kGaussian[kRadius + 1] = {0.39905028, 0.24203623, 0.05400558, 0.00443305};

/// One dimension of the Gaussian; beyond the ends lies nothing. Elements are `step` apart.
void smoothLine(const double* in, double* out, int step) {
  for (int i = 0; i < 256; ++i) {
    double sum = 0;
    for (int k = std::max(-kRadius, -i); k <= std::min(kRadius, 255 - i); ++k)
      sum += kGaussian[std::abs(k)] * in[(i + k) * step];
    out[i * step] = sum;
  }
}

/// -log(P * g) * g in place. The floor keeps pairs never seen at a finite, large cost.
void entropyOf(double* p, double* scratch, double floor) {
  smoothLine(p, scratch, 1);
  for (int i = 0; i < 256; ++i) scratch[i] = -std::log(std::max(scratch[i], floor));
  smoothLine(scratch, p, 1);
}

void smoothTable(double* table, double* scratch) {
  for (int i = 0; i < 256; ++i) smoothLine(table + 256 * i, scratch + 256 * i, 1);
  for (int k = 0; k < 256; ++k) smoothLine(scratch + k, table + k, 256);
}

}  // namespace

void MutualInformation::update(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                               ImageView<const float> disparity) {
  joint_.fill(0);
  long long pixels = 0;
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < left.width; ++x) {
      const float d = disparity.at(y, x);
      if (!(d == d)) continue;
      const int from = x - static_cast<int>(std::lround(d));
      if (from < 0 || from >= right.width) continue;
      joint_[256 * left.at(y, x) + right.at(y, from)] += 1;
      ++pixels;
    }
  if (pixels == 0) {
    table_.fill(0);
    return;
  }

  left_.fill(0);
  right_.fill(0);
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; ++k) {
      const double p = joint_[256 * i + k] /= static_cast<double>(pixels);
      left_[i] += p;
      right_[k] += p;
    }
  const double floor = 1e-3 / static_cast<double>(pixels);
  entropyOf(left_.data(), line_.data(), floor);
  entropyOf(right_.data(), line_.data(), floor);
  smoothTable(joint_.data(), scratch_.data());
  for (double& p : joint_) p = -std::log(std::max(p, floor));
  smoothTable(joint_.data(), scratch_.data());

  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; ++k) joint_[256 * i + k] -= left_[i] + right_[k];  // -mi
  const auto [low, high] = std::minmax_element(joint_.begin(), joint_.end());
  const double base = *low, scale = *high > *low ? kMaximumCost / (*high - *low) : 0;
  for (int i = 0; i < 65536; ++i)
    table_[i] = static_cast<std::uint8_t>(std::lround((joint_[i] - base) * scale));
}

}  // namespace pomona
