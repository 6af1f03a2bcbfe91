// Distances along rays, counted in steps; 0xffff means that no source lies on the ray.

namespace pomona {
namespace {

void advanceRays(const std::uint16_t* previous, const std::uint16_t* open, int n,
                 std::uint16_t* __restrict out) {
  for (int x = 0; x < n; ++x) {
    const std::uint16_t capped = previous[x] < 0xfffe ? previous[x] : 0xfffe;
    out[x] = static_cast<std::uint16_t>((capped + 1) & open[x]);
  }
}

}  // namespace
}  // namespace pomona
