#include "camera/votes.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

constexpr int kBinsPerPixel = 4;

}  // namespace

Votes::Votes(double largest) : bins_(static_cast<std::size_t>(largest * kBinsPerPixel) + 2 + kBinsPerPixel) {}

void Votes::clear() {
  std::fill(bins_.begin(), bins_.end(), 0.0);
}

void Votes::add(double value, double weight) {
  const double place = value * kBinsPerPixel;
  if (!(place >= 0 && place < static_cast<double>(bins_.size() - 1))) return;
  const auto bin = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(bin);
  bins_[bin] += weight * (1 - rest);
  bins_[bin + 1] += weight * rest;
}

Votes::Peak Votes::peak(double other_than) const {
  constexpr double kApart_px = 2;
  std::size_t best = 0;
  double best_sum = 0;
  for (std::size_t begin = 0; begin + kBinsPerPixel <= bins_.size(); ++begin) {
    if (std::abs((static_cast<double>(begin) + 0.5 * kBinsPerPixel) / kBinsPerPixel - other_than) <
        kApart_px + 0.5)
      continue;
    double sum = 0;
    for (std::size_t i = 0; i < kBinsPerPixel; ++i) sum += bins_[begin + i];
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = begin;
  }
  double moment = 0;
  for (std::size_t i = best; i < best + kBinsPerPixel; ++i) moment += bins_[i] * static_cast<double>(i);
  return {best_sum > 0 ? moment / best_sum / kBinsPerPixel : 0, best_sum};
}

double largestParallax(const RegionSamples& region) {
  double largest = 0;
  for (const SurfaceSample& s : region.samples) largest = std::max(largest, s.parallax_px);
  return largest;
}

std::vector<double> centralWeights(const RegionSamples& region, const Outline& outline) {
  constexpr double kDecline = 1.6;  // exp(-1.6) = 0.2
  std::vector<double> weights;
  weights.reserve(region.samples.size());
  for (const SurfaceSample& s : region.samples) {
    const cv::Point2d offset = (cv::Point2d(s.x_px, s.y_px) - outline.center_px) * (1 / outline.radius_px);
    weights.push_back(s.trust * std::exp(-kDecline * offset.dot(offset)));
  }
  return weights;
}

}  // namespace pomona
