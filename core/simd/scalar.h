// The byte-vector vocabulary kernels are written in, spelled out without intrinsics: 16 bytes at a time.
//
// avx2.h and avx512.h (and any further instruction set) offer the same names with the same meaning. A kernel
// file includes exactly one of them; everything has internal linkage, so that no copy compiled for one CPU
// can be linked into code that runs on another.
//
// 16-bit words come in pairs of vectors (low, high): `low` holds bytes 0..7 of every 128-bit block of the
// byte vector, `high` bytes 8..15. Words keep that block order; lane numbers below always count bytes.
#pragma once

#include <cstdint>

namespace {
namespace simd {

struct U8 {
  std::uint8_t v[16];
};
struct U16 {
  std::uint16_t v[8];
};
constexpr int kBytes = 16;  ///< bytes in a U8
constexpr int kUnrolledVectors =
    0;  ///< vectors per pixel worth a kernel of their own: none, they only take time to compile

#if defined(POMONA_FEW_KERNELS)  // a sanitizer chokes on these loops when all of them are inlined
#define POMONA_OP inline
#else
#define POMONA_OP inline __attribute__((always_inline))
#endif

template <typename F>
POMONA_OP U8 eachByte(F f) {
  U8 r;
  for (int i = 0; i < 16; ++i) r.v[i] = static_cast<std::uint8_t>(f(i));
  return r;
}
template <typename F>
POMONA_OP U16 eachWord(F f) {
  U16 r;
  for (int i = 0; i < 8; ++i) r.v[i] = static_cast<std::uint16_t>(f(i));
  return r;
}

POMONA_OP U8 loadUnaligned(const std::uint8_t* p) {
  return eachByte([&](int i) { return p[i]; });
}
POMONA_OP U8 load(const std::uint8_t* p) {
  return loadUnaligned(p);
}  ///< p on a kBytes boundary
POMONA_OP void store(std::uint8_t* p, U8 a) {
  for (int i = 0; i < 16; ++i) p[i] = a.v[i];
}
POMONA_OP U8 broadcast(std::uint8_t x) {
  return eachByte([&](int) { return x; });
}
/// Four equal bytes in memory, spread over the vector (cheaper than spreading one).
POMONA_OP U8 broadcastQuad(const std::uint32_t* p) {
  return broadcast(static_cast<std::uint8_t>(*p));
}

POMONA_OP U8 add(U8 a, U8 b) {  ///< modulo 256
  return eachByte([&](int i) { return a.v[i] + b.v[i]; });
}
POMONA_OP U8 sub(U8 a, U8 b) {  ///< modulo 256
  return eachByte([&](int i) { return a.v[i] - b.v[i]; });
}
POMONA_OP U8 min(U8 a, U8 b) {
  return eachByte([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
POMONA_OP U8 max(U8 a, U8 b) {
  return eachByte([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
POMONA_OP U8 average(U8 a, U8 b) {  ///< (a + b + 1) / 2
  return eachByte([&](int i) { return (a.v[i] + b.v[i] + 1) >> 1; });
}
POMONA_OP U8 bitXor(U8 a, U8 b) {
  return eachByte([&](int i) { return a.v[i] ^ b.v[i]; });
}
POMONA_OP U8 popcount(U8 a) {  ///< set bits of each byte
  return eachByte([&](int i) {
    unsigned x = a.v[i];
    x -= (x >> 1) & 0x55;
    x = (x & 0x33) + ((x >> 2) & 0x33);
    return (x + (x >> 4)) & 0x0F;
  });
}
POMONA_OP U8 previousLane(U8 a) {  ///< lane i takes lane i - 1; lane 0 takes 255
  return eachByte([&](int i) { return i > 0 ? a.v[i - 1] : 255; });
}
POMONA_OP U8 nextLane(U8 a) {  ///< lane i takes lane i + 1; the last lane takes 255
  return eachByte([&](int i) { return i < 15 ? a.v[i + 1] : 255; });
}

/// The smallest byte of each of four vectors.
struct Minima {
  std::uint8_t v[4];
};
POMONA_OP std::uint8_t smallest(U8 a) {
  std::uint8_t m = a.v[0];
  for (int i = 1; i < 16; ++i) m = a.v[i] < m ? a.v[i] : m;
  return m;
}
POMONA_OP Minima minima(U8 a, U8 b, U8 c, U8 d) {
  return {{smallest(a), smallest(b), smallest(c), smallest(d)}};
}
/// The same as minima(a, a, b, b), with less work.
POMONA_OP Minima minima(U8 a, U8 b) {
  return {{smallest(a), smallest(a), smallest(b), smallest(b)}};
}
/// Four quads for broadcastQuad; p on a 16-byte boundary.
POMONA_OP void storeMinima(std::uint32_t* p, Minima m) {
  for (int k = 0; k < 4; ++k) p[k] = m.v[k] * 0x01010101u;
}
POMONA_OP U8 lastMinimum(Minima m) {
  return broadcast(m.v[3]);
}  ///< that of the fourth vector, in every lane

POMONA_OP U16 load16(const std::uint16_t* p) {
  return eachWord([&](int i) { return p[i]; });
}
POMONA_OP void store16(std::uint16_t* p, U16 a) {
  for (int i = 0; i < 8; ++i) p[i] = a.v[i];
}
POMONA_OP U16 broadcast16(std::uint16_t x) {
  return eachWord([&](int) { return x; });
}
POMONA_OP U16 add16(U16 a, U16 b) {
  return eachWord([&](int i) { return a.v[i] + b.v[i]; });
}
POMONA_OP U16 min16(U16 a, U16 b) {
  return eachWord([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
POMONA_OP U16 or16(U16 a, U16 b) {
  return eachWord([&](int i) { return a.v[i] | b.v[i]; });
}
POMONA_OP U16 widenLow(U8 a) {
  return eachWord([&](int i) { return a.v[i]; });
}
POMONA_OP U16 widenHigh(U8 a) {
  return eachWord([&](int i) { return a.v[8 + i]; });
}
template <int kFactor>
POMONA_OP U16 addScaledLow(U8 a, U8 b) {  ///< a + kFactor * b in 16 bits; kFactor < 128
  return eachWord([&](int i) { return a.v[i] + kFactor * b.v[i]; });
}
template <int kFactor>
POMONA_OP U16 addScaledHigh(U8 a, U8 b) {
  return eachWord([&](int i) { return a.v[8 + i] + kFactor * b.v[8 + i]; });
}
template <int kBits>
POMONA_OP U16 shiftLeft16(U16 a) {
  return eachWord([&](int i) { return static_cast<std::uint16_t>(a.v[i] << kBits); });
}
POMONA_OP std::uint16_t smallest16(U16 a) {  ///< the smallest word
  std::uint16_t m = a.v[0];
  for (int i = 1; i < 8; ++i) m = a.v[i] < m ? a.v[i] : m;
  return m;
}
POMONA_OP std::uint16_t first16(U16 a) {
  return a.v[0];
}
/// Bit i set: lane i of the pair (low, high) equals v.
POMONA_OP std::uint64_t equalLanes(U16 low, U16 high, U16 v) {
  std::uint64_t lanes = 0;
  for (int i = 0; i < 8; ++i) {
    lanes |= static_cast<std::uint64_t>(low.v[i] == v.v[i]) << i;
    lanes |= static_cast<std::uint64_t>(high.v[i] == v.v[i]) << (8 + i);
  }
  return lanes;
}
/// Where v <= best: best and its label give way to v and v_label.
POMONA_OP void keepSmaller(U16& best, U16& label, U16 v, U16 v_label) {
  for (int i = 0; i < 8; ++i) {
    const bool take = v.v[i] <= best.v[i];
    best.v[i] = take ? v.v[i] : best.v[i];
    label.v[i] = take ? v_label.v[i] : label.v[i];
  }
}
/// Lane-wise minimum of `smallest` and v, leaving out the lanes whose label is first, first + 1 or first + 2.
POMONA_OP U16 minimumAway(U16 smallest, U16 v, U16 label, U16 first) {
  return eachWord([&](int i) {
    const bool near = static_cast<std::uint16_t>(label.v[i] - first.v[i]) <= 2;
    return near || smallest.v[i] < v.v[i] ? smallest.v[i] : v.v[i];
  });
}
/// Lane i of the pair takes lane i + 1; the last lane takes the first word of `fill`.
POMONA_OP void dropFirstLane(U16& low, U16& high, U16 fill) {
  const std::uint16_t first_high = high.v[0];
  for (int i = 0; i < 7; ++i) {
    low.v[i] = low.v[i + 1];
    high.v[i] = high.v[i + 1];
  }
  low.v[7] = first_high;
  high.v[7] = fill.v[0];
}

}  // namespace simd
}  // namespace
