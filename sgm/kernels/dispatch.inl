// Turns the run-time number of vectors per pixel into a compile-time one where that pays.
#pragma once

namespace {

template <int kValue>
struct Constant {
  constexpr int operator()() const { return kValue; }
};

/// Calls f(Constant<n>{}); n = 0 stands for "any number, read it at run time".
template <typename F>
inline __attribute__((always_inline)) void withVectors(int vectors, F f) {
#if defined(POMONA_FEW_KERNELS)  // a sanitizer takes a quarter of an hour over all of them
  vectors == 1 ? f(Constant<1>{}) : f(Constant<0>{});
#else
  if constexpr (simd::kUnrolledVectors >= 4) {
    switch (vectors) {
      case 1:
        return f(Constant<1>{});
      case 2:
        return f(Constant<2>{});
      case 3:
        return f(Constant<3>{});
      case 4:
        return f(Constant<4>{});
    }
  }
  if constexpr (simd::kUnrolledVectors >= 8) {
    switch (vectors) {
      case 5:
        return f(Constant<5>{});
      case 6:
        return f(Constant<6>{});
      case 7:
        return f(Constant<7>{});
      case 8:
        return f(Constant<8>{});
    }
  }
  f(Constant<0>{});
#endif
}

}  // namespace
