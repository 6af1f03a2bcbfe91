// Holes, and distances along rays, counted in steps; 0xffff means that no source lies on the ray.

namespace pomona {
namespace {

int findHoles(const float* disparity, const std::uint8_t* state, HoleStates states, int n,
              std::uint16_t* __restrict open, std::uint8_t* __restrict is_hole) {
  int count = 0;
  for (int x = 0; x < n; ++x) {
    const int known = disparity[x] == disparity[x];
    const int measured = state[x] == states.measured;
    const int source = (measured & known) | (state[x] == states.plane);
    const int hole = (measured & (known ^ 1)) | ((state[x] >= states.missing) & (state[x] != states.masked));
    open[x] = static_cast<std::uint16_t>(source - 1);
    is_hole[x] = static_cast<std::uint8_t>(hole);
    count += hole;
  }
  return count;
}

void advanceRays(const std::uint16_t* open, int n, std::uint16_t* __restrict steps) {
  for (int x = 0; x < n; ++x) {
    const std::uint16_t capped = steps[x] < 0xfffe ? steps[x] : 0xfffe;
    steps[x] = static_cast<std::uint16_t>((capped + 1) & open[x]);
  }
}

}  // namespace
}  // namespace pomona
