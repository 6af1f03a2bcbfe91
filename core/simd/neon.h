// The byte-vector vocabulary for NEON on AArch64. scalar.h explains every operation.
#pragma once

#include <arm_neon.h>

#include <cstdint>

namespace {
namespace simd {

using U8 = uint8x16_t;
using U16 = uint16x8_t;
constexpr int kBytes = 16;
constexpr int kUnrolledVectors = 4;

#define POMONA_OP inline __attribute__((always_inline))

POMONA_OP U8 load(const std::uint8_t* p) {
  return vld1q_u8(p);
}
POMONA_OP U8 loadUnaligned(const std::uint8_t* p) {
  return vld1q_u8(p);
}
POMONA_OP void store(std::uint8_t* p, U8 v) {
  vst1q_u8(p, v);
}
POMONA_OP U8 broadcast(std::uint8_t x) {
  return vdupq_n_u8(x);
}
POMONA_OP U8 broadcastQuad(const std::uint32_t* p) {
  return vreinterpretq_u8_u32(vld1q_dup_u32(p));
}

POMONA_OP U8 add(U8 a, U8 b) {
  return vaddq_u8(a, b);
}
POMONA_OP U8 sub(U8 a, U8 b) {
  return vsubq_u8(a, b);
}
POMONA_OP U8 min(U8 a, U8 b) {
  return vminq_u8(a, b);
}
POMONA_OP U8 max(U8 a, U8 b) {
  return vmaxq_u8(a, b);
}
POMONA_OP U8 average(U8 a, U8 b) {
  return vrhaddq_u8(a, b);
}
POMONA_OP U8 bitXor(U8 a, U8 b) {
  return veorq_u8(a, b);
}
POMONA_OP U8 popcount(U8 a) {
  return vcntq_u8(a);
}
POMONA_OP U8 previousLane(U8 v) {
  return vextq_u8(vdupq_n_u8(255), v, 15);
}
POMONA_OP U8 nextLane(U8 v) {
  return vextq_u8(v, vdupq_n_u8(255), 1);
}

using Minima = uint8x16_t;  // the four minima, over and over
POMONA_OP Minima minima(U8 a, U8 b, U8 c, U8 d) {
  const U8 quarters = vpminq_u8(vpminq_u8(a, b), vpminq_u8(c, d));  // four bytes of each
  const U8 halves = vpminq_u8(quarters, quarters);
  return vpminq_u8(halves, halves);
}
POMONA_OP Minima minima(U8 a, U8 b) {
  const U8 halves = vpminq_u8(a, b), quarters = vpminq_u8(halves, halves);
  const U8 eighths = vpminq_u8(quarters, quarters);  // two bytes of each, over and over
  return vminq_u8(eighths, vrev16q_u8(eighths));
}
POMONA_OP void storeMinima(std::uint32_t* p, Minima m) {
  const uint8x16_t spread = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
  vst1q_u32(p, vreinterpretq_u32_u8(vqtbl1q_u8(m, spread)));
}
POMONA_OP U8 lastMinimum(Minima m) {
  return vdupq_laneq_u8(m, 3);
}

POMONA_OP U16 load16(const std::uint16_t* p) {
  return vld1q_u16(p);
}
POMONA_OP void store16(std::uint16_t* p, U16 v) {
  vst1q_u16(p, v);
}
POMONA_OP U16 broadcast16(std::uint16_t x) {
  return vdupq_n_u16(x);
}
POMONA_OP U16 add16(U16 a, U16 b) {
  return vaddq_u16(a, b);
}
POMONA_OP U16 min16(U16 a, U16 b) {
  return vminq_u16(a, b);
}
POMONA_OP U16 or16(U16 a, U16 b) {
  return vorrq_u16(a, b);
}
POMONA_OP U16 widenLow(U8 a) {
  return vmovl_u8(vget_low_u8(a));
}
POMONA_OP U16 widenHigh(U8 a) {
  return vmovl_high_u8(a);
}
template <int kFactor>
POMONA_OP U16 addScaledLow(U8 a, U8 b) {
  return vmlal_u8(widenLow(a), vget_low_u8(b), vdup_n_u8(kFactor));
}
template <int kFactor>
POMONA_OP U16 addScaledHigh(U8 a, U8 b) {
  return vmlal_high_u8(widenHigh(a), b, vdupq_n_u8(kFactor));
}
template <int kBits>
POMONA_OP U16 shiftLeft16(U16 a) {
  return vshlq_n_u16(a, kBits);
}
POMONA_OP std::uint16_t smallest16(U16 v) {
  return vminvq_u16(v);
}
POMONA_OP std::uint16_t first16(U16 v) {
  return vgetq_lane_u16(v, 0);
}
POMONA_OP std::uint64_t equalLanes(U16 low, U16 high, U16 v) {
  const uint8x8_t bit = {1, 2, 4, 8, 16, 32, 64, 128};
  const uint8x8_t first = vand_u8(vmovn_u16(vceqq_u16(low, v)), bit);
  const uint8x8_t second = vand_u8(vmovn_u16(vceqq_u16(high, v)), bit);
  return vaddv_u8(first) | static_cast<std::uint64_t>(vaddv_u8(second)) << 8;
}
POMONA_OP void keepSmaller(U16& best, U16& label, U16 v, U16 v_label) {
  label = vbslq_u16(vcleq_u16(v, best), v_label, label);
  best = vminq_u16(best, v);
}
POMONA_OP U16 minimumAway(U16 smallest, U16 v, U16 label, U16 first) {
  const uint16x8_t away = vcgtq_u16(vsubq_u16(label, first), vdupq_n_u16(2));
  return vbslq_u16(away, vminq_u16(smallest, v), smallest);
}
POMONA_OP void dropFirstLane(U16& low, U16& high, U16 fill) {
  low = vextq_u16(low, high, 1);
  high = vextq_u16(high, fill, 1);
}

}  // namespace simd
}  // namespace
