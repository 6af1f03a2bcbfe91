// A quick look at a pair: the range it needs, before the pair itself is matched.
#pragma once

#include <cstdint>

#include "engine/sparse_stage.h"
#include "pyramid/scale.h"

namespace pomona {

/// The pair matched at a quarter of its size, as preset `fast` does and with a test for uniqueness: whatever
/// stands there has passed every check.
class CoarseLook {
 public:
  static constexpr int kFactor = 4;

  /// Looks at the 8-bit gray of `pair` for at most `disparities` disparities of the full size, from
  /// `min_disparity` on. The map is valid until the next call, in pixels of its own size:
  /// scaledLength(side, kFactor).
  const MatchMaps& run(const MatchInput& pair, int min_disparity, int disparities,
                       ImageView<const std::uint8_t> mask, Isa isa, int threads);

  /// Whether the pixel of the map has a disparity, and a row around it that shows something. Across what is
  /// blank, disparities of its border spread and pass every check.
  bool hasFound(int y, int x) const;

  /// Pixels of the pair per pixel of the map of the last call.
  double ratio() const { return ratio_; }

 private:
  Image<std::uint8_t> left_, right_, mask_;
  ScaleScratch scale_;
  SparseStage stage_;
  double ratio_ = kFactor;
};

}  // namespace pomona
