// Chunks of per-pixel flags: computed by a loop the compiler vectorises, visited where they are set.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace pomona {

/// One byte per pixel, with at most one bit set.
struct alignas(64) FlagChunk {
  static constexpr int kPixels = 64;
  std::uint8_t flags[kPixels] = {};

  /// Calls `visit(i)` in rising order for every i < `count` whose flag is set; skips eight unset flags at a
  /// time.
  template <typename Visit>
  void forEachSet(int count, Visit visit) const {
    static_assert(std::endian::native == std::endian::little);
    for (int i = 0; i < count; i += 8) {
      std::uint64_t word;
      std::memcpy(&word, flags + i, 8);
      for (; word != 0; word &= word - 1) {
        const int at = i + std::countr_zero(word) / 8;
        if (at >= count) return;  // left over from a fuller chunk
        visit(at);
      }
    }
  }
};

}  // namespace pomona
