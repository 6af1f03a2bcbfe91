// Horizontal Sobel response, the gradient part of the blended cost.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"
#include "sgm/kernels.h"

namespace pomona {

/// clamp(128 + S / 4, 0, 255) with S = [1 2 1]' x [-1 0 1] applied to `gray`, the border replicated; in the
/// current scope of `arena`.
ImageView<std::uint8_t> computeSobel(ImageView<const std::uint8_t> gray, const SgmKernels& kernels,
                                     Arena& arena, int threads);

}  // namespace pomona
