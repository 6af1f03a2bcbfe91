#include "core/image.h"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pomona {

void* allocateAligned(std::size_t bytes, Pages pages) {
  constexpr std::size_t kHugePage = std::size_t{2} << 20, kCacheLine = 64;
  const std::size_t alignment = pages == Pages::kHuge && bytes >= 2 * kHugePage ? kHugePage : kCacheLine;
  if (bytes > static_cast<std::size_t>(-1) - alignment) throw std::bad_alloc();
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (!memory) throw std::bad_alloc();
#if defined(__linux__)
  if (alignment == kHugePage) madvise(memory, rounded, MADV_HUGEPAGE);  // only a wish; a refusal does no harm
#endif
  return memory;
}

}  // namespace pomona
