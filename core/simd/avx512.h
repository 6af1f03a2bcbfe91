// The byte-vector vocabulary for AVX-512 (BW, VL, VBMI, BITALG). scalar.h explains every operation.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace {
namespace simd {

using U8 = __m512i;   // 64 unsigned bytes
using U16 = __m512i;  // 32 unsigned 16-bit words
constexpr int kBytes = 64;
constexpr int kUnrolledVectors = 4;

#define POMONA_OP inline __attribute__((always_inline))

POMONA_OP U8 load(const std::uint8_t* p) {
  return _mm512_load_si512(p);
}
POMONA_OP U8 loadUnaligned(const std::uint8_t* p) {
  return _mm512_loadu_si512(p);
}
POMONA_OP void store(std::uint8_t* p, U8 v) {
  _mm512_store_si512(p, v);
}
POMONA_OP U8 broadcast(std::uint8_t x) {
  return _mm512_set1_epi8(static_cast<char>(x));
}
POMONA_OP U8 broadcastQuad(const std::uint32_t* p) {
  return _mm512_set1_epi32(static_cast<int>(*p));
}

POMONA_OP U8 add(U8 a, U8 b) {
  return _mm512_add_epi8(a, b);
}
POMONA_OP U8 sub(U8 a, U8 b) {
  return _mm512_sub_epi8(a, b);
}
POMONA_OP U8 min(U8 a, U8 b) {
  return _mm512_min_epu8(a, b);
}
POMONA_OP U8 max(U8 a, U8 b) {
  return _mm512_max_epu8(a, b);
}
POMONA_OP U8 average(U8 a, U8 b) {
  return _mm512_avg_epu8(a, b);
}
POMONA_OP U8 bitXor(U8 a, U8 b) {
  return _mm512_xor_si512(a, b);
}
POMONA_OP U8 popcount(U8 a) {
  return _mm512_popcnt_epi8(a);
}

POMONA_OP U8 previousLane(U8 v) {
  alignas(64) static constexpr std::uint8_t kIndex[64] = {
      0,  0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20,
      21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42,
      43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62};
  return _mm512_mask_permutexvar_epi8(_mm512_set1_epi8(-1), ~1ull, _mm512_load_si512(kIndex), v);
}
POMONA_OP U8 nextLane(U8 v) {
  alignas(64) static constexpr std::uint8_t kIndex[64] = {
      1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22,
      23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44,
      45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 63};
  return _mm512_mask_permutexvar_epi8(_mm512_set1_epi8(-1), ~0ull >> 1, _mm512_load_si512(kIndex), v);
}

using Minima = __m512i;  // 128-bit block k holds the minimum of vector k in every byte
POMONA_OP Minima minimaOfBlocks(U8 m) {
  m = min(m, _mm512_shuffle_epi32(m, static_cast<_MM_PERM_ENUM>(0x4E)));
  m = min(m, _mm512_shuffle_epi32(m, static_cast<_MM_PERM_ENUM>(0xB1)));
  m = min(m, _mm512_rol_epi32(m, 16));
  return min(m, _mm512_rol_epi32(m, 8));
}
POMONA_OP Minima minima(U8 a, U8 b, U8 c, U8 d) {
  const U8 ab = min(_mm512_mask_blend_epi64(0xF0, a, b), _mm512_shuffle_i64x2(a, b, 0x4E));
  const U8 cd = min(_mm512_mask_blend_epi64(0xF0, c, d), _mm512_shuffle_i64x2(c, d, 0x4E));
  return minimaOfBlocks(min(_mm512_shuffle_i64x2(ab, cd, 0x88), _mm512_shuffle_i64x2(ab, cd, 0xDD)));
}
POMONA_OP Minima minima(U8 a, U8 b) {
  const U8 ab = min(_mm512_mask_blend_epi64(0xF0, a, b), _mm512_shuffle_i64x2(a, b, 0x4E));
  return minimaOfBlocks(min(ab, _mm512_shuffle_i64x2(ab, ab, 0xB1)));
}
POMONA_OP void storeMinima(std::uint32_t* p, Minima m) {
  const __m512i pick = _mm512_castsi128_si512(_mm_setr_epi32(0, 4, 8, 12));
  _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm512_castsi512_si128(_mm512_permutexvar_epi32(pick, m)));
}
POMONA_OP U8 lastMinimum(Minima m) {
  return _mm512_shuffle_i32x4(m, m, 0xFF);
}

POMONA_OP U16 load16(const std::uint16_t* p) {
  return _mm512_load_si512(p);
}
POMONA_OP void store16(std::uint16_t* p, U16 v) {
  _mm512_store_si512(p, v);
}
POMONA_OP U16 broadcast16(std::uint16_t x) {
  return _mm512_set1_epi16(static_cast<short>(x));
}
POMONA_OP U16 add16(U16 a, U16 b) {
  return _mm512_add_epi16(a, b);
}
POMONA_OP U16 min16(U16 a, U16 b) {
  return _mm512_min_epu16(a, b);
}
POMONA_OP U16 or16(U16 a, U16 b) {
  return _mm512_or_si512(a, b);
}
POMONA_OP U16 widenLow(U8 a) {
  return _mm512_unpacklo_epi8(a, _mm512_setzero_si512());
}
POMONA_OP U16 widenHigh(U8 a) {
  return _mm512_unpackhi_epi8(a, _mm512_setzero_si512());
}
template <int kFactor>
POMONA_OP U16 addScaledLow(U8 a, U8 b) {
  return _mm512_maddubs_epi16(_mm512_unpacklo_epi8(a, b), _mm512_set1_epi16(1 + 256 * kFactor));
}
template <int kFactor>
POMONA_OP U16 addScaledHigh(U8 a, U8 b) {
  return _mm512_maddubs_epi16(_mm512_unpackhi_epi8(a, b), _mm512_set1_epi16(1 + 256 * kFactor));
}
template <int kBits>
POMONA_OP U16 shiftLeft16(U16 a) {
  return _mm512_slli_epi16(a, kBits);
}
POMONA_OP std::uint16_t smallest16(U16 v) {
  const __m256i a = _mm256_min_epu16(_mm512_castsi512_si256(v), _mm512_extracti64x4_epi64(v, 1));
  const __m128i b = _mm_min_epu16(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(b)));
}
POMONA_OP std::uint16_t first16(U16 v) {
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm512_castsi512_si128(v)));
}
POMONA_OP std::uint64_t equalLanes(U16 low, U16 high, U16 v) {
  const std::uint64_t a = _mm512_cmpeq_epi16_mask(low, v), b = _mm512_cmpeq_epi16_mask(high, v);
  return _pdep_u64(a, 0x00FF00FF00FF00FFull) | _pdep_u64(b, 0xFF00FF00FF00FF00ull);
}
POMONA_OP void keepSmaller(U16& best, U16& label, U16 v, U16 v_label) {
  const __mmask32 take = _mm512_cmple_epu16_mask(v, best);
  best = _mm512_min_epu16(best, v);
  label = _mm512_mask_mov_epi16(label, take, v_label);
}
POMONA_OP U16 minimumAway(U16 smallest, U16 v, U16 label, U16 first) {
  const __mmask32 away = _mm512_cmpgt_epu16_mask(_mm512_sub_epi16(label, first), _mm512_set1_epi16(2));
  return _mm512_mask_min_epu16(smallest, away, smallest, v);
}
POMONA_OP void dropFirstLane(U16& low, U16& high, U16 fill) {
  const U16 next = _mm512_alignr_epi64(fill, low, 2);
  low = _mm512_alignr_epi8(high, low, 2);
  high = _mm512_alignr_epi8(next, high, 2);
}

}  // namespace simd
}  // namespace
