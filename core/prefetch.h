// Asking for memory before it is needed.
#pragma once

#include <cstddef>

#include "core/image.h"

namespace pomona {

/// Asks for `count` elements of a row of an image from column x on; for none if there is no such row. The
/// hardware fetches ahead of a walk by itself, but not across the end of a page: rows of large images are
/// about a page long, so that whoever does little per pixel waits at the start of every one.
template <typename T>
void prefetch(ImageView<T> image, int y, int x, int count) {
  constexpr std::size_t kLine = 64;
  if (y < 0 || y >= image.height) return;
  const char* const p = reinterpret_cast<const char*>(image.row(y) + x);
  for (std::size_t i = 0; i < sizeof(T) * static_cast<std::size_t>(count); i += kLine)
    __builtin_prefetch(p + i);
}
template <typename T>
void prefetchRow(ImageView<T> image, int y) {
  prefetch(image, y, 0, image.width);
}

}  // namespace pomona
