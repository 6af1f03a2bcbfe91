// Matching cost from the joint statistics of a pair (Kim et al. 2003, Hirschmueller 2008 sec. 2.1-2.2).
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"

namespace pomona {

/// Turns a disparity guess into the cost of every pair of gray values.
///
///   P(i,k)  = share of the pixels p with (left(p), right(p - d)) = (i,k)                      (Eq. 5)
///   h(i,k)  = -log(P * g) * g,  h1(i) and h2(k) likewise from the marginals of P              (Eq. 4 and 8)
///   mi(i,k) = h1(i) + h2(k) - h(i,k),  cost = -mi                                             (Eq. 9 and 10)
///
/// with g a 7x7 Gaussian of standard deviation 1. The cost is scaled linearly to 0 .. kMaximumCost.
class MutualInformation {
 public:
  static constexpr int kMaximumCost = 127;

  /// `disparity`: NaN where unknown; these pixels and those that map outside the right image are left out. If
  /// no pixel is left, every pair costs 0.
  void update(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
              ImageView<const float> disparity);

  /// cost[256 * left + right].
  const std::array<std::uint8_t, 65536>& table() const { return table_; }

 private:
  std::array<double, 65536> joint_, scratch_;
  std::array<double, 256> left_, right_, line_;
  std::array<std::uint8_t, 65536> table_{};
};

}  // namespace pomona
