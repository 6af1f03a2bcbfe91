// Vectors of floats, as wide as the compiler flags of the including kernel file allow.
//
// Written with the vector types GCC and Clang share, so one text serves every instruction set: `+ - * /`,
// comparisons and `mask ? a : b` are the compiler's own, lane by lane, and become one instruction each. All
// lanes do IEEE arithmetic in the order of the text, so a lane's result does not depend on the width.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace pomona {
namespace {

#if defined(__AVX512F__)
constexpr int kFloatLanes = 16;
#elif defined(__AVX2__)
constexpr int kFloatLanes = 8;
#else
constexpr int kFloatLanes = 4;  // SSE2, NEON: what every CPU of the family has
#endif

typedef float Floats __attribute__((vector_size(4 * kFloatLanes)));
typedef std::int32_t Ints __attribute__((vector_size(4 * kFloatLanes)));  ///< also a mask: 0 or -1 per lane

/// `p` needs no alignment.
inline Floats load(const float* p) {
  Floats v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
inline Ints load(const std::int32_t* p) {
  Ints v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
inline void store(float* p, Floats v) {
  __builtin_memcpy(p, &v, sizeof v);
}
inline void store(std::int32_t* p, Ints v) {
  __builtin_memcpy(p, &v, sizeof v);
}
/// Stores the first `count` lanes only; all of them if there are fewer.
inline void storeFirst(float* p, Floats v, int count) {
  if (count >= kFloatLanes) return store(p, v);
  for (int i = 0; i < count; ++i) p[i] = v[i];
}

inline Floats broadcast(float x) {
  return x - Floats{};  // x - 0 is x, even for -0
}

// a < b ? a : b and a > b ? a : b, so `b` if they are equal or one is NaN. Spelt as intrinsics because GCC
// does not see through the ternary when one side is a constant; masked, with all lanes on, because GCC 12
// warns of the uninitialised operand inside its own unmasked ones.
#if defined(__AVX512F__)
inline Floats min(Floats a, Floats b) {
  return _mm512_maskz_min_ps(0xFFFF, a, b);
}
inline Floats max(Floats a, Floats b) {
  return _mm512_maskz_max_ps(0xFFFF, a, b);
}
#elif defined(__AVX2__)
inline Floats min(Floats a, Floats b) {
  return _mm256_min_ps(a, b);
}
inline Floats max(Floats a, Floats b) {
  return _mm256_max_ps(a, b);
}
#else
inline Floats min(Floats a, Floats b) {
  return a < b ? a : b;
}
inline Floats max(Floats a, Floats b) {
  return a > b ? a : b;
}
#endif

inline Ints min(Ints a, Ints b) {
  return a < b ? a : b;
}
inline Ints max(Ints a, Ints b) {
  return a > b ? a : b;
}

inline Ints isNan(Floats v) {
  return v != v;
}

/// True if a lane of a mask is set.
inline bool anyOf(Ints mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX2__)
  return _mm256_testz_si256(reinterpret_cast<__m256i>(mask), reinterpret_cast<__m256i>(mask)) == 0;
#else
  std::int32_t any = 0;
  for (int i = 0; i < kFloatLanes; ++i) any |= mask[i];
  return any != 0;
#endif
}

inline bool anyNan(Floats v) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(v, v, _CMP_UNORD_Q) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_ps(_mm256_cmp_ps(v, v, _CMP_UNORD_Q)) != 0;
#else
  return anyOf(isNan(v));
#endif
}

/// The bits of a vector, read as the other type.
inline Ints bitsOf(Floats v) {
  return reinterpret_cast<Ints>(v);
}
inline Floats floatsOf(Ints v) {
  return reinterpret_cast<Floats>(v);
}

/// 32-bit elements that lie apart from each other in memory; floatsOf() reads them as what they are.
inline Ints gather(const void* base, Ints index) {
#if defined(__AVX512F__)
  return reinterpret_cast<Ints>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(index), base, 4));
#elif defined(__AVX2__)
  return reinterpret_cast<Ints>(
      _mm256_i32gather_epi32(static_cast<const int*>(base), reinterpret_cast<__m256i>(index), 4));
#else
  Ints v;
  for (int i = 0; i < kFloatLanes; ++i) v[i] = static_cast<const std::int32_t*>(base)[index[i]];
  return v;
#endif
}
/// The same at offsets counted in bytes.
inline Ints gatherBytes(const void* base, Ints offset) {
#if defined(__AVX512F__)
  return reinterpret_cast<Ints>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(offset), base, 1));
#elif defined(__AVX2__)
  return reinterpret_cast<Ints>(
      _mm256_i32gather_epi32(static_cast<const int*>(base), reinterpret_cast<__m256i>(offset), 1));
#else
  Ints v;
  for (int i = 0; i < kFloatLanes; ++i) {
    std::int32_t word;
    __builtin_memcpy(&word, static_cast<const std::uint8_t*>(base) + offset[i], sizeof word);
    v[i] = word;
  }
  return v;
#endif
}
/// out[i] = from[index[i]]; GCC 12 makes no gathers of such a loop.
inline void gatherRow(const float* from, const std::int32_t* index, int count, float* __restrict out) {
  int i = 0;
  for (; i + kFloatLanes <= count; i += kFloatLanes) store(out + i, floatsOf(gather(from, load(index + i))));
  for (; i < count; ++i) out[i] = from[index[i]];
}
/// first[i] and second[i]: from[index[i]] and the element after it.
inline void gatherPairs(const float* from, const std::int32_t* index, int count, float* __restrict first,
                        float* __restrict second) {
  int i = 0;
#if defined(__AVX512F__)
  const __m512i evens = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odds = _mm512_add_epi32(evens, _mm512_set1_epi32(1));
  for (; i + kFloatLanes <= count; i += kFloatLanes) {
    const auto pairsAt = [&](int k) {
      __m256i at;
      __builtin_memcpy(&at, index + k, sizeof at);
      return _mm512_i32gather_epi64(at, from, 4);
    };
    const __m512i low = pairsAt(i), high = pairsAt(i + kFloatLanes / 2);
    store(first + i, reinterpret_cast<Floats>(_mm512_permutex2var_epi32(low, evens, high)));
    store(second + i, reinterpret_cast<Floats>(_mm512_permutex2var_epi32(low, odds, high)));
  }
#endif
  gatherRow(from, index + i, count - i, first + i);
  gatherRow(from + 1, index + i, count - i, second + i);
}

}  // namespace
}  // namespace pomona
