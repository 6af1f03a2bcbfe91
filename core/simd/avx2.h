// The byte-vector vocabulary for AVX2. scalar.h explains every operation.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace {
namespace simd {

using U8 = __m256i;   // 32 unsigned bytes
using U16 = __m256i;  // 16 unsigned 16-bit words
constexpr int kBytes = 32;
constexpr int kUnrolledVectors = 8;

#define POMONA_OP inline __attribute__((always_inline))

POMONA_OP U8 load(const std::uint8_t* p) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
}
POMONA_OP U8 loadUnaligned(const std::uint8_t* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}
POMONA_OP void store(std::uint8_t* p, U8 v) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(p), v);
}
POMONA_OP U8 broadcast(std::uint8_t x) {
  return _mm256_set1_epi8(static_cast<char>(x));
}
POMONA_OP U8 broadcastQuad(const std::uint32_t* p) {
  return _mm256_set1_epi32(static_cast<int>(*p));
}

POMONA_OP U8 add(U8 a, U8 b) {
  return _mm256_add_epi8(a, b);
}
POMONA_OP U8 sub(U8 a, U8 b) {
  return _mm256_sub_epi8(a, b);
}
POMONA_OP U8 min(U8 a, U8 b) {
  return _mm256_min_epu8(a, b);
}
POMONA_OP U8 max(U8 a, U8 b) {
  return _mm256_max_epu8(a, b);
}
POMONA_OP U8 average(U8 a, U8 b) {
  return _mm256_avg_epu8(a, b);
}
POMONA_OP U8 bitXor(U8 a, U8 b) {
  return _mm256_xor_si256(a, b);
}
POMONA_OP U8 popcount(U8 a) {  // two 16-entry table look-ups, one per nibble
  const U8 table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,  //
                                    0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const U8 nibble = _mm256_set1_epi8(15);
  const U8 low = _mm256_and_si256(a, nibble), high = _mm256_and_si256(_mm256_srli_epi16(a, 4), nibble);
  return _mm256_add_epi8(_mm256_shuffle_epi8(table, low), _mm256_shuffle_epi8(table, high));
}

POMONA_OP U8 previousLane(U8 v) {
  return _mm256_alignr_epi8(v, _mm256_permute2x128_si256(v, _mm256_set1_epi8(-1), 0x02), 15);
}
POMONA_OP U8 nextLane(U8 v) {
  return _mm256_alignr_epi8(_mm256_permute2x128_si256(v, _mm256_set1_epi8(-1), 0x21), v, 1);
}

using Minima = __m256i;  // 64-bit parts hold, in every byte, the minima of a, c, b, d

POMONA_OP Minima minimaOfParts(U8 m) {
  m = min(m, _mm256_shuffle_epi32(m, 0xB1));
  const __m256i by_two = _mm256_setr_epi8(2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13,  //
                                          2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13);
  const __m256i by_one = _mm256_setr_epi8(1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14,  //
                                          1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
  m = min(m, _mm256_shuffle_epi8(m, by_two));
  return min(m, _mm256_shuffle_epi8(m, by_one));
}
POMONA_OP Minima minima(U8 a, U8 b, U8 c, U8 d) {
  const U8 ab = min(_mm256_blend_epi32(a, b, 0xF0), _mm256_permute2x128_si256(a, b, 0x21));
  const U8 cd = min(_mm256_blend_epi32(c, d, 0xF0), _mm256_permute2x128_si256(c, d, 0x21));
  return minimaOfParts(min(_mm256_unpacklo_epi64(ab, cd), _mm256_unpackhi_epi64(ab, cd)));
}
POMONA_OP Minima minima(U8 a, U8 b) {
  const U8 ab = min(_mm256_unpacklo_epi64(a, b), _mm256_unpackhi_epi64(a, b));
  return minimaOfParts(min(ab, _mm256_permute4x64_epi64(ab, 0x4E)));
}
POMONA_OP void storeMinima(std::uint32_t* p, Minima m) {
  const __m256i picked = _mm256_permutevar8x32_epi32(m, _mm256_setr_epi32(0, 4, 2, 6, 0, 0, 0, 0));
  _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm256_castsi256_si128(picked));
}
POMONA_OP U8 lastMinimum(Minima m) {
  return _mm256_permute4x64_epi64(m, 0xFF);
}

POMONA_OP U16 load16(const std::uint16_t* p) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
}
POMONA_OP void store16(std::uint16_t* p, U16 v) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(p), v);
}
POMONA_OP U16 broadcast16(std::uint16_t x) {
  return _mm256_set1_epi16(static_cast<short>(x));
}
POMONA_OP U16 add16(U16 a, U16 b) {
  return _mm256_add_epi16(a, b);
}
POMONA_OP U16 min16(U16 a, U16 b) {
  return _mm256_min_epu16(a, b);
}
POMONA_OP U16 or16(U16 a, U16 b) {
  return _mm256_or_si256(a, b);
}
POMONA_OP U16 widenLow(U8 a) {
  return _mm256_unpacklo_epi8(a, _mm256_setzero_si256());
}
POMONA_OP U16 widenHigh(U8 a) {
  return _mm256_unpackhi_epi8(a, _mm256_setzero_si256());
}
template <int kFactor>
POMONA_OP U16 addScaledLow(U8 a, U8 b) {
  return _mm256_maddubs_epi16(_mm256_unpacklo_epi8(a, b), _mm256_set1_epi16(1 + 256 * kFactor));
}
template <int kFactor>
POMONA_OP U16 addScaledHigh(U8 a, U8 b) {
  return _mm256_maddubs_epi16(_mm256_unpackhi_epi8(a, b), _mm256_set1_epi16(1 + 256 * kFactor));
}
template <int kBits>
POMONA_OP U16 shiftLeft16(U16 a) {
  return _mm256_slli_epi16(a, kBits);
}
POMONA_OP std::uint16_t smallest16(U16 v) {
  const __m128i a = _mm_min_epu16(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(a)));
}
POMONA_OP std::uint16_t first16(U16 v) {
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm256_castsi256_si128(v)));
}
POMONA_OP std::uint64_t equalLanes(U16 low, U16 high, U16 v) {
  const __m256i equal = _mm256_packs_epi16(_mm256_cmpeq_epi16(low, v), _mm256_cmpeq_epi16(high, v));
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(equal));
}
POMONA_OP void keepSmaller(U16& best, U16& label, U16 v, U16 v_label) {
  best = _mm256_min_epu16(best, v);
  label = _mm256_blendv_epi8(label, v_label, _mm256_cmpeq_epi16(best, v));
}
POMONA_OP U16 minimumAway(U16 smallest, U16 v, U16 label, U16 first) {
  const U16 distance = _mm256_sub_epi16(label, first);
  const U16 near = _mm256_cmpeq_epi16(_mm256_min_epu16(distance, _mm256_set1_epi16(2)), distance);
  return _mm256_min_epu16(smallest, _mm256_or_si256(v, near));
}
POMONA_OP void dropFirstLane(U16& low, U16& high, U16 fill) {
  const U16 next = _mm256_permute2x128_si256(low, fill, 0x21);
  low = _mm256_alignr_epi8(high, low, 2);
  high = _mm256_alignr_epi8(next, high, 2);
}

}  // namespace simd
}  // namespace
