// Where neighbouring pixels are connected: by a step of at most max_step_px; what is unknown is not. GCC
// vectorises the loops as they stand.
#pragma once

namespace pomona {
namespace {

inline void breaksOf(const float* row, int count, float max_step_px, std::uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const float here = row[i], before = row[i - 1];
    const bool unknown = (here != here) & (before != before);
    out[i] = !(unknown | (__builtin_fabsf(here - before) <= max_step_px));
  }
}

inline void linksOf(const float* upper, const float* lower, int count, float max_step_px,
                    std::uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const bool here = __builtin_fabsf(upper[i] - lower[i]) <= max_step_px;
    const bool before = __builtin_fabsf(upper[i - 1] - lower[i - 1]) <= max_step_px;
    const bool above = __builtin_fabsf(upper[i] - upper[i - 1]) <= max_step_px;
    const bool below = __builtin_fabsf(lower[i] - lower[i - 1]) <= max_step_px;
    out[i] = here & !(before & above & below);
  }
}

}  // namespace
}  // namespace pomona
