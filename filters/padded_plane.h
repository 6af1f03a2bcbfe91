// An image with a border, so that window kernels need no special case at the image's edges.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/arena.h"
#include "core/image.h"

namespace pomona {

/// row(y) is valid for y in [-radius, height + radius); in a row, x in [-radius, width + radius + kOverrun)
/// may be read: kernels work on whole vectors and run past the right edge.
template <typename T>
class PaddedImage {
 public:
  static constexpr int kOverrun = 15;

  PaddedImage() = default;

  /// Takes its memory from the current scope of `arena`. Sets the border and the overrun to `border`; the
  /// image itself is left unspecified.
  PaddedImage(Arena& arena, int width, int height, int radius, T border)
      : image_(arena.image<T>(width + 2 * radius + kOverrun, height + 2 * radius)), radius_(radius) {
    for (int y = -radius; y < height + radius; ++y) {
      T* begin = row(y) - radius;
      T* end = begin + image_.width;
      if (y >= 0 && y < height) {
        std::fill(begin, row(y), border);
        begin = row(y) + width;
      }
      std::fill(begin, end, border);
    }
  }
  T* row(int y) const { return image_.row(y + radius_) + radius_; }
  std::ptrdiff_t stride() const { return image_.stride; }

 private:
  ImageView<T> image_;
  int radius_ = 0;
};

using PaddedPlane = PaddedImage<float>;

}  // namespace pomona
