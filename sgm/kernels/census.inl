// Eight comparisons per pixel, packed into a byte. GCC vectorises this loop as it stands.
#pragma once

#include <cstdint>

namespace {

template <typename T>
void censusRow(const T* const a[8], const T* const b[8], int width, std::uint8_t* __restrict out) {
  const T *a0 = a[0], *a1 = a[1], *a2 = a[2], *a3 = a[3], *a4 = a[4], *a5 = a[5], *a6 = a[6], *a7 = a[7];
  const T *b0 = b[0], *b1 = b[1], *b2 = b[2], *b3 = b[3], *b4 = b[4], *b5 = b[5], *b6 = b[6], *b7 = b[7];
  for (int x = 0; x < width; ++x) {
    std::uint8_t code = a0[x] < b0[x] ? 1 : 0;
    code |= a1[x] < b1[x] ? 2 : 0;
    code |= a2[x] < b2[x] ? 4 : 0;
    code |= a3[x] < b3[x] ? 8 : 0;
    code |= a4[x] < b4[x] ? 16 : 0;
    code |= a5[x] < b5[x] ? 32 : 0;
    code |= a6[x] < b6[x] ? 64 : 0;
    code |= a7[x] < b7[x] ? 128 : 0;
    out[x] = code;
  }
}

}  // namespace
