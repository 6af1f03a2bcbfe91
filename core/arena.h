// Memory for what a stage needs only while it runs: stages that follow one another share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/image.h"

namespace pomona {

/// Hands out memory upwards and takes it back in scopes: what was taken since a scope began goes back, all at
/// once, when it ends. Serves one thread at a time; those who work on what was taken may be many.
///
/// The memory itself is kept from frame to frame. It grows piece by piece; as soon as none of it is in use,
/// several pieces are given back, and the next one has room for all that was ever in use at a time. So after
/// the first frames nothing is allocated any more, and no stage adds to the memory of another.
class Arena {
 public:
  /// While it lives, memory may be taken. Scopes nest.
  class Scope {
   public:
    explicit Scope(Arena& arena) : arena_(arena), begin_(arena.end_) {}
    ~Scope() { arena_.giveBack(begin_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    friend class Arena;
    Arena& arena_;
    const struct Place {
      std::size_t piece = 0, used = 0;  // bytes of that piece
      std::size_t total = 0;            // bytes taken
    } begin_;
  };

  /// `count` elements on a 64-byte boundary, of unspecified values. Throws std::bad_alloc.
  template <typename T>
  T* take(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= kAlignment);
    return reinterpret_cast<T*>(takeBytes(count, sizeof(T)));
  }

  /// An image of unspecified values whose rows start on 64-byte boundaries.
  template <typename T>
  ImageView<T> image(int width, int height) {
    const std::ptrdiff_t stride = Image<T>::strideFor(width);
    return {take<T>(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height)), width, height,
            stride};
  }

  /// Bytes held, in use or not.
  std::size_t capacity() const;

 private:
  static constexpr std::size_t kAlignment = 64;
  struct Free {
    void operator()(std::uint8_t* p) const { std::free(p); }
  };
  struct Piece {
    std::unique_ptr<std::uint8_t, Free> memory;
    std::size_t bytes;
  };

  std::uint8_t* takeBytes(std::size_t count, std::size_t size);
  void giveBack(const Scope::Place& begin);

  std::vector<Piece> pieces_;
  Scope::Place end_;
  std::size_t most_ = 0;  // bytes that were ever taken at a time
};

}  // namespace pomona
