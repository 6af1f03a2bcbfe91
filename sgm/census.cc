#include "sgm/census.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMarginX = 4, kMarginY = 3;  // of the largest window, 9x7
constexpr int kRing = 8;                   // rows that are kept padded, at least those of a window

struct Offset {
  int dx, dy;
};
struct Comparison {
  Offset a, b;  // the bit is I(p + a) < I(p + b)
};
struct Window {
  int count = 0;
  std::array<Comparison, 8 * kMaxCensusPlanes> comparisons{};
  constexpr void add(Offset a, Offset b) { comparisons[count++] = {a, b}; }
};

/// Every neighbour against the centre.
constexpr Window fullWindow(int width, int height) {
  Window w;
  for (int dy = -height / 2; dy <= height / 2; ++dy)
    for (int dx = -width / 2; dx <= width / 2; ++dx)
      if (dx != 0 || dy != 0) w.add({dx, dy}, {0, 0});
  return w;
}

/// Every second neighbour against the centre, as on the fields of one colour.
constexpr Window checkerboardWindow(int width, int height) {
  Window w;
  for (int dy = -height / 2; dy <= height / 2; ++dy)
    for (int dx = -width / 2; dx <= width / 2; ++dx)
      if ((dx != 0 || dy != 0) && (dx + dy) % 2 == 0) w.add({dx, dy}, {0, 0});
  return w;
}

/// Every neighbour against the one opposite the centre.
constexpr Window centerSymmetricWindow(int width, int height) {
  Window w;
  for (int dy = -height / 2; dy <= 0; ++dy)
    for (int dx = -width / 2; dx <= width / 2; ++dx)
      if (dy < 0 || dx < 0) w.add({dx, dy}, {-dx, -dy});
  return w;
}

const Window& windowOf(MatchingCost cost) {
  static constexpr Window k5x5 = fullWindow(5, 5), k7x7 = fullWindow(7, 7), k9x7 = fullWindow(9, 7),
                          kSymmetric9x7 = centerSymmetricWindow(9, 7),
                          kCheckerboard9x7 = checkerboardWindow(9, 7);
  switch (cost) {
    case MatchingCost::kCensus5x5:
      return k5x5;
    case MatchingCost::kCensus7x7:
      return k7x7;
    case MatchingCost::kCensus9x7:
      return k9x7;
    case MatchingCost::kCenterSymmetricCensus9x7:
      return kSymmetric9x7;
    case MatchingCost::kBlended:
      return kCheckerboard9x7;
    case MatchingCost::kMutualInformation:
      break;
  }
  assert(!"not a census cost");
  return k5x5;
}

template <typename T>
void padRow(const T* from, int width, T* to) {
  std::fill_n(to, kMarginX, from[0]);
  std::memcpy(to + kMarginX, from, sizeof(T) * static_cast<std::size_t>(width));
  std::fill_n(to + kMarginX + width, kMarginX, from[width - 1]);
}

}  // namespace

template <typename T>
CensusPlanes computeCensus(ImageView<const T> gray, MatchingCost cost, const SgmKernels& kernels,
                           Arena& arena, int threads) {
  const Window& window = windowOf(cost);
  const int width = gray.width, height = gray.height;
  CensusPlanes out;
  out.planes = (window.count + 7) / 8;
  for (int p = 0; p < out.planes; ++p) out.plane[p] = arena.image<std::uint8_t>(width, height);

  const Arena::Scope scope(arena);
  // A ring of rows for every strip, where its own would be: they stay in the cache.
  const auto padded = arena.image<T>(width + 2 * kMarginX, std::max(height, kRing));
  parallelStrips(threads, height, kRing, [&](int begin, int end) {
    const auto paddedRow = [&](int y) { return padded.row(begin + (y - begin + kMarginY) % kRing); };
    const auto pad = [&](int y) { padRow(gray.row(std::clamp(y, 0, height - 1)), width, paddedRow(y)); };
    for (int y = begin - kMarginY; y < begin + kMarginY; ++y) pad(y);
    for (int y = begin; y < end; ++y) {
      pad(y + kMarginY);
      const auto at = [&](Offset o) { return paddedRow(y + o.dy) + kMarginX + o.dx; };
      for (int p = 0; p < out.planes; ++p) {
        const T *a[8], *b[8];
        for (int k = 0; k < 8; ++k) {
          const int i = 8 * p + k;  // a missing comparison is that of the centre with itself: bit 0
          a[k] = i < window.count ? at(window.comparisons[i].a) : at({0, 0});
          b[k] = i < window.count ? at(window.comparisons[i].b) : at({0, 0});
        }
        if constexpr (std::is_same_v<T, std::uint8_t>)
          kernels.census8(a, b, width, out.plane[p].row(y));
        else
          kernels.census16(a, b, width, out.plane[p].row(y));
      }
    }
  });
  return out;
}

template CensusPlanes computeCensus(ImageView<const std::uint8_t>, MatchingCost, const SgmKernels&, Arena&,
                                    int);
template CensusPlanes computeCensus(ImageView<const std::uint16_t>, MatchingCost, const SgmKernels&, Arena&,
                                    int);

}  // namespace pomona
