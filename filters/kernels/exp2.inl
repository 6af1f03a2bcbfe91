// Powers of two with the same bytes on every instruction set.
#pragma once

namespace pomona {
namespace {

/// Replaces x by 2^x, for x <= 0, with a relative error below 3e-6; arguments below -100 give 2^-100, far
/// below any weight that counts yet large enough to keep products with a disparity out of the slow denormal
/// range.
///
/// With n = round(x), 2^x = 2^n 2^(x - n): adding 1.5 * 2^23 rounds x and leaves n in the low mantissa bits,
/// from where a shift carries it into the exponent. The polynomial is the minimax (Remez) approximation of
/// degree 4 of 2^f on [-1/2, 1/2].
///
/// The vectors take every step together: one alone is a single long chain of dependent operations, several
/// side by side keep the processor busy.
template <int kCount>
inline void exp2NonPositive(Floats (&x)[kCount]) {
  constexpr float kRound = 12582912.0f;
  Floats shifted[kCount], p[kCount];
  for (Floats& v : x) v = max(v, broadcast(-100.0f));
  for (int i = 0; i < kCount; ++i) shifted[i] = x[i] + kRound;
  for (int i = 0; i < kCount; ++i) x[i] = x[i] - (shifted[i] - kRound);
  for (int i = 0; i < kCount; ++i) p[i] = x[i] * 0.009570101908f + 0.05591786032f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.2402474483f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.6931218147f;
  for (int i = 0; i < kCount; ++i) p[i] = p[i] * x[i] + 0.9999992614f;
  for (int i = 0; i < kCount; ++i) x[i] = floatsOf(bitsOf(p[i]) + (bitsOf(shifted[i]) << 23));
}

}  // namespace
}  // namespace pomona
