// Runs of connected pixels, row by row, and their union. Pixels are connected by a step of at most
// max_step_px; what is unknown is not. GCC vectorises the loops over flags as they stand.
#pragma once

namespace pomona {
namespace {

constexpr int kFlags = 64;  ///< of a word

/// Bit i is flags[i], 0 or 1.
inline std::uint64_t packFlags(const std::uint8_t* flags) {
#if defined(__AVX512BW__)
  const __m512i bytes = _mm512_loadu_si512(flags);
  return _mm512_test_epi8_mask(bytes, bytes);
#else
  std::uint64_t bits = 0;
  for (int i = 0; i < kFlags; i += 8) {
    std::uint64_t bytes;
    __builtin_memcpy(&bytes, flags + i, 8);
    bits |= bytes * 0x0102040810204080ull >> 56 << i;  // the product's top byte gathers the eight
  }
  return bits;
#endif
}

/// flags[i]: pixel i is not connected to the one before it, unless both are unknown. Reads row[-1], but for
/// the row's `first` pixel, which has flag 0.
inline __attribute__((always_inline)) std::uint64_t breaksOf(const float* row, int first, int count,
                                                             float max_step_px) {
  alignas(64) std::uint8_t flags[kFlags] = {};
  for (int i = first; i < count; ++i) {
    const float here = row[i], before = row[i - 1];
    const bool unknown = (here != here) & (before != before);
    flags[i] = !(unknown | (__builtin_fabsf(here - before) <= max_step_px));
  }
  return packFlags(flags);
}

inline __attribute__((always_inline)) std::uint64_t verticalLinks(const float* upper, const float* lower,
                                                                  int count, float max_step_px) {
  alignas(64) std::uint8_t flags[kFlags] = {};
  for (int i = 0; i < count; ++i) flags[i] = __builtin_fabsf(upper[i] - lower[i]) <= max_step_px;
  return packFlags(flags);
}

/// What a run is before it is united with any. Without branches: nothing foretells where it is unknown.
inline SpeckleRun runOf(const float* row, int begin, int end, int enough_px) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, row + begin, sizeof bits);
  const int unknown = (bits & 0x7FFFFFFF) > 0x7F800000 ? -1 : 0;
  const int size = (end - begin) | (unknown & 0x7FFFFFFF);
  return {begin, size < enough_px ? -size : -enough_px};
}

int findRuns(const float* row, int width, float max_step_px, int enough_px, std::uint64_t* __restrict breaks,
             SpeckleRun* __restrict runs) {
  int count = 0, begin = 0;
  for (int x = 0; x < width; x += kFlags) {
    std::uint64_t bits = x == 0 ? breaksOf(row, 1, width < kFlags ? width : kFlags, max_step_px)
                         : width - x >= kFlags ? breaksOf(row + x, 0, kFlags, max_step_px)
                                               : breaksOf(row + x, 0, width - x, max_step_px);
    breaks[x / kFlags] = bits;
    for (; bits != 0; bits &= bits - 1) {
      const int end = x + __builtin_ctzll(bits);
      runs[count++] = runOf(row, begin, end, enough_px);
      begin = end;
    }
  }
  runs[count++] = runOf(row, begin, width, enough_px);
  return count;
}

/// Halves the path to the root on its way.
inline int findRoot(SpeckleRun* runs, int i) {
  for (int next; (next = runs[i].link) >= 0; i = next)
    if (const int after = runs[next].link; after >= 0) runs[i].link = after;
  return i;
}

inline void unite(SpeckleRun* runs, int a, int b, int enough_px) {
  a = findRoot(runs, a);
  b = findRoot(runs, b);
  if (a == b) return;
  const auto size = -static_cast<std::uint32_t>(runs[a].link) - static_cast<std::uint32_t>(runs[b].link);
  if (size >= static_cast<std::uint32_t>(enough_px)) {
    runs[a].link = runs[b].link = -enough_px;  // both will stay: they need not know of each other
  } else {
    runs[b].link = a;
    runs[a].link = -static_cast<int>(size);
  }
}

void uniteRuns(const SpeckleRow& above, const SpeckleRow& below, int width, float max_step_px, int enough_px,
               SpeckleRun* runs) {
  int a = above.first, b = below.first;  // the runs that the current word begins in
  std::uint64_t before = 0;
  for (int x = 0; x < width; x += kFlags) {
    const float *upper = above.disparity + x, *lower = below.disparity + x;
    const std::uint64_t links = width - x >= kFlags ? verticalLinks(upper, lower, kFlags, max_step_px)
                                                    : verticalLinks(upper, lower, width - x, max_step_px);
    const std::uint64_t breaks_a = above.breaks[x / kFlags], breaks_b = below.breaks[x / kFlags];
    // But where the pixels to the left are linked, too, and connected to these.
    std::uint64_t needed = links & ~((links << 1 | before) & ~breaks_a & ~breaks_b);
    for (; needed != 0; needed &= needed - 1) {
      const std::uint64_t up_to = needed ^ (needed - 1);
      unite(runs, a + __builtin_popcountll(breaks_a & up_to), b + __builtin_popcountll(breaks_b & up_to),
            enough_px);
    }
    a += __builtin_popcountll(breaks_a);
    b += __builtin_popcountll(breaks_b);
    before = links >> (kFlags - 1);
  }
}

}  // namespace
}  // namespace pomona
