// Horizontal Sobel response, the gradient part of the blended cost.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sgm/kernels.h"

namespace pomona {

class SobelFilter {
 public:
  /// out = clamp(128 + S / 4, 0, 255) with S = [1 2 1]' x [-1 0 1] applied to `gray`, the border replicated.
  void compute(ImageView<const std::uint8_t> gray, Image<std::uint8_t>& out, const SgmKernels& kernels,
               int threads);

 private:
  Image<std::uint8_t> padded_;
};

}  // namespace pomona
