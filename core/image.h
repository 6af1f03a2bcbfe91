// Views of pixel rows, and aligned buffers that keep their memory from frame to frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <type_traits>

namespace pomona {

/// A borrowed image. `stride` counts elements, not bytes. Copies are cheap; rows need no alignment.
template <typename T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  T* row(int y) const { return data + y * stride; }
  T& at(int y, int x) const { return data[y * stride + x]; }
  bool empty() const { return width <= 0 || height <= 0; }
  operator ImageView<const T>() const  // NOLINT(google-explicit-constructor): T* converts to const T* as well
      requires(!std::is_const_v<T>) {
    return {data, width, height, stride};
  }
};

/// An 8-bit guide image, `channels` (1 or 3) values per pixel side by side. `stride` counts bytes.
struct GuideView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  int channels = 1;
  std::ptrdiff_t stride = 0;

  const std::uint8_t* row(int y) const { return data + y * stride; }
};

enum class Pages {
  kHuge,   ///< fewer page faults, where all of the memory is used
  kSmall,  ///< what is never touched stays unused, where only some of it may be
};

/// Memory on a 64-byte boundary, to be given to std::free. Blocks of several megabytes ask for huge pages
/// unless told not to. Throws std::bad_alloc.
void* allocateAligned(std::size_t bytes, Pages pages);

/// Raw memory on a 64-byte boundary. Growing discards the contents; shrinking keeps the memory for the next
/// frame.
template <typename T, Pages kPages = Pages::kHuge>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr std::size_t kAlignment = 64;

  /// Afterwards at least `count` elements are there; their values are unspecified.
  void resize(std::size_t count) {
    if (count <= capacity_) return;
    memory_.reset();
    capacity_ = 0;
    memory_.reset(static_cast<T*>(allocateAligned(count * sizeof(T), kPages)));
    capacity_ = count;
  }
  T* data() { return memory_.get(); }
  const T* data() const { return memory_.get(); }
  T& operator[](std::size_t i) { return memory_.get()[i]; }
  const T& operator[](std::size_t i) const { return memory_.get()[i]; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> memory_;
  std::size_t capacity_ = 0;
};

/// An owned image whose rows start on 64-byte boundaries.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height) { resize(width, height); }

  /// Elements from row to row.
  static std::ptrdiff_t strideFor(int width) {
    constexpr std::ptrdiff_t kStep =
        Buffer<T>::kAlignment / sizeof(T) > 0 ? Buffer<T>::kAlignment / sizeof(T) : 1;
    return (width + kStep - 1) / kStep * kStep;
  }
  void resize(int width, int height) {
    width_ = width;
    height_ = height;
    stride_ = strideFor(width);
    buffer_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height));
  }
  int width() const { return width_; }
  int height() const { return height_; }
  T* row(int y) { return buffer_.data() + y * stride_; }
  const T* row(int y) const { return buffer_.data() + y * stride_; }
  ImageView<T> view() { return {buffer_.data(), width_, height_, stride_}; }
  ImageView<const T> view() const { return {buffer_.data(), width_, height_, stride_}; }

 private:
  Buffer<T> buffer_;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

}  // namespace pomona
