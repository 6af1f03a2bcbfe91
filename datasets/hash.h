// Random numbers that are the same everywhere: std's distributions are not.
#pragma once

#include <cstdint>

namespace pomona {

/// Spreads every bit of `value` over all 64 (two multiply-and-fold rounds).
constexpr std::uint64_t hash(std::uint64_t value) {
  value = (value ^ (value >> 32)) * 0xd6e8feb86659fd93u;
  value = (value ^ (value >> 32)) * 0xd6e8feb86659fd93u;
  return value ^ (value >> 32);
}

/// The upper bits of `h` as a number in [0, 1).
constexpr double unitInterval(std::uint64_t h) {
  return static_cast<double>(h >> 11) * 0x1p-53;
}

/// A sequence of numbers in [low, high), decided by the seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(hash(seed + 1)) {}
  double between(double low, double high) { return low + (high - low) * unitInterval(hash(++state_)); }

 private:
  std::uint64_t state_;
};

}  // namespace pomona
