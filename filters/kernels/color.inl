// Differences of colours that are packed into one word each, see filters/guided_plane.h.
#pragma once

namespace pomona {
namespace {

typedef std::uint8_t ColorBytes __attribute__((vector_size(4 * kFloatLanes)));

/// |a - b|, channel by channel.
inline ColorBytes absoluteDifference(Ints a, Ints b) {
  const ColorBytes u = reinterpret_cast<ColorBytes>(a), v = reinterpret_cast<ColorBytes>(b);
  return (u > v ? u : v) - (u < v ? u : v);
}

/// The sum of the channels of each pixel.
inline Ints sumOfChannels(ColorBytes color) {
  const Ints word = reinterpret_cast<Ints>(color);
  return (word & 0xFF) + (word >> 8 & 0xFF) + (word >> 16);
}

/// Lanes in which every channel is below `bound`.
inline Ints allChannelsBelow(ColorBytes color, std::uint8_t bound) {
  return reinterpret_cast<Ints>(color >= bound) == 0;
}

inline Ints loadColors(const std::uint32_t* p) {
  Ints v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

}  // namespace
}  // namespace pomona
