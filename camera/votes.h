// Which value most votes agree on.
#pragma once

#include <vector>

#include "camera/region.h"

namespace pomona {

/// A histogram of parallaxes, in pixels.
class Votes {
 public:
  struct Peak {
    double position = 0, weight = 0;
  };

  /// Values from 0 to `largest`; others are left out.
  explicit Votes(double largest);

  void clear();
  void add(double value, double weight);
  /// Peaks that are closer than this are one: their windows overlap. No more, for a leaf may lie less than a
  /// pixel before a far fruit.
  static constexpr double kApart_px = 0.5;
  /// The window of 1/2 px with most votes: their sum and their mean. Windows that come within kApart_px of
  /// `other_than` do not count.
  Peak peak(double other_than = -10) const;

 private:
  std::vector<double> bins_;
  std::size_t begin_ = 0, end_ = 0;  // of the bins with votes
};

double largestParallax(const RegionSamples& region);

}  // namespace pomona
