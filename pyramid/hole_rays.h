// The holes of a disparity map, and the nearest source to the left and right of, above and below every hole.
#pragma once

#include <array>
#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "pyramid/kernels.h"

namespace pomona {

struct Ray {
  int dx, dy;
};
/// The two along the row come first.
inline constexpr std::array<Ray, kHoleRays> kRays = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

class HoleRays {
 public:
  struct Pixel {
    std::uint16_t x, y;
  };
  static constexpr std::uint16_t kNoSource = 0xffff;

  /// Lists the holes, in row-major order: pixels that are missing but not masked, or measured but NaN.
  /// Sources are the other measured pixels, and those of state kFilledPlane. Everything lies in the current
  /// scope of `arena`, to which the following calls add nothing.
  void findHoles(ImageView<const float> disparity, ImageView<const std::uint8_t> state, Arena& arena,
                 const PyramidKernels& kernels, int threads);

  /// Follows all rays from all holes found, for up to `radius_px` steps. Each hole goes on from its neighbour
  /// on the ray, so the time does not depend on how large the holes are.
  void follow(int radius_px, const PyramidKernels& kernels, int threads);

  int count() const { return count_; }
  const Pixel* holes() const { return holes_; }
  /// Steps from each hole along kRays[ray] to its first source, or kNoSource.
  const std::uint16_t* steps(std::size_t ray) const {
    return steps_ + ray * static_cast<std::size_t>(count_);
  }

 private:
  void followRow(std::size_t ray, int y, int radius_px);
  void followColumns(std::size_t ray, int radius_px, const PyramidKernels& kernels);

  int count_ = 0;
  int* row_begin_ = nullptr;            // index of each row's first hole
  Pixel* holes_ = nullptr;              // room for all pixels
  std::uint16_t* steps_ = nullptr;      // one plane of count_ values per ray
  ImageView<std::uint16_t> open_;       // 0 at sources, 0xffff elsewhere
  ImageView<std::uint16_t> distances_;  // of a row's pixels to the source above, and to that below
};

}  // namespace pomona
