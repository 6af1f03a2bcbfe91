// Distances between descriptors, one table per instruction set. All tables give the same bytes.
#pragma once

#include <cstdint>

namespace pomona {

enum class Isa;  // core/cpu.h; kernel files must not see the standard headers it includes

/// How much of the city-block distance (the sum of differences) and how much of the chessboard distance (the
/// largest one) makes a distance.
struct DistanceWeights {
  float cityblock, chessboard;
};

/// out[i] = the distance of `query` to the i-th of `count` descriptors that lie one after the other in
/// `others`; all have `length` values. Of bytes, what is `limit` or more by a part of the sum may be that
/// part.
struct DistanceKernels {
  void (*squaredEuclid8)(const std::uint8_t* query, const std::uint8_t* others, int length, int count,
                         float limit, float* out);
  void (*squaredEuclid32)(const float* query, const float* others, int length, int count, float* out);
  void (*weighted8)(const std::uint8_t* query, const std::uint8_t* others, int length, int count,
                    DistanceWeights weights, float limit, float* out);
  void (*weighted32)(const float* query, const float* others, int length, int count, DistanceWeights weights,
                     float* out);
};

/// `isa` must be one of usableIsas().
const DistanceKernels& distanceKernels(Isa isa);

}  // namespace pomona
