#include "camera/votes.h"

#include <algorithm>
#include <cmath>

namespace pomona {
namespace {

constexpr int kBinsPerPixel = 8;
constexpr int kWindow = kBinsPerPixel / 2;

}  // namespace

Votes::Votes(double largest) : bins_(static_cast<std::size_t>(largest * kBinsPerPixel) + 2 + kWindow) {
  clear();
}

void Votes::clear() {
  std::fill(bins_.begin(), bins_.end(), 0.0);
  begin_ = bins_.size();
  end_ = 0;
}

void Votes::add(double value, double weight) {
  const double place = value * kBinsPerPixel;
  if (!(place >= 0 && place < static_cast<double>(bins_.size() - 1))) return;
  const auto bin = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(bin);
  bins_[bin] += weight * (1 - rest);
  bins_[bin + 1] += weight * rest;
  begin_ = std::min(begin_, bin);
  end_ = std::max(end_, bin + 2);
}

Votes::Peak Votes::peak(double other_than) const {
  const auto isOther = [&](std::size_t begin) {
    const double middle_px = (static_cast<double>(begin) + 0.5 * (kWindow - 1)) / kBinsPerPixel;
    return std::abs(middle_px - other_than) >= kApart_px;
  };
  std::size_t best = 0;
  double best_sum = 0, sum = 0;
  const std::size_t first = begin_ - std::min<std::size_t>(begin_, kWindow - 1);
  for (std::size_t i = first; i < std::min(first + kWindow - 1, end_); ++i) sum += bins_[i];
  for (std::size_t begin = first; begin < end_ && begin + kWindow <= bins_.size(); ++begin) {
    sum += bins_[begin + kWindow - 1];
    if (sum > best_sum && isOther(begin)) {
      best_sum = sum;
      best = begin;
    }
    sum -= bins_[begin];
  }
  double moment = 0;
  for (std::size_t i = best; i < best + kWindow; ++i) moment += bins_[i] * static_cast<double>(i);
  return {best_sum > 0 ? moment / best_sum / kBinsPerPixel : 0, best_sum};
}

double largestParallax(const RegionSamples& region) {
  double largest = 0;
  for (const SurfaceSample& s : region.samples) largest = std::max(largest, s.parallax_px);
  return largest;
}

}  // namespace pomona
