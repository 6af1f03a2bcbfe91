#include "core/arena.h"

#include <algorithm>
#include <new>

namespace pomona {
namespace {

constexpr std::size_t kSmallestPiece = std::size_t{1} << 16;

}  // namespace

std::uint8_t* Arena::takeBytes(std::size_t count, std::size_t size) {
  if (count > (static_cast<std::size_t>(-1) - kAlignment) / size) throw std::bad_alloc();
  const std::size_t bytes = (count * size + kAlignment - 1) / kAlignment * kAlignment;
  while (end_.piece < pieces_.size() && pieces_[end_.piece].bytes - end_.used < bytes)
    end_ = {end_.piece + 1, 0, end_.total};
  if (end_.piece == pieces_.size()) {
    // A quarter more than was ever needed: it costs nothing as long as nobody touches it, and spares a piece
    // for a stage that needs a little more than those before it.
    const std::size_t wanted = std::max({bytes, kSmallestPiece, pieces_.empty() ? most_ + most_ / 4 : 0});
    pieces_.push_back({nullptr, wanted});
    try {
      pieces_.back().memory.reset(static_cast<std::uint8_t*>(allocateAligned(wanted, Pages::kHuge)));
    } catch (...) {
      pieces_.pop_back();
      throw;
    }
  }
  std::uint8_t* taken = pieces_[end_.piece].memory.get() + end_.used;
  end_.used += bytes;
  end_.total += bytes;
  most_ = std::max(most_, end_.total);
  return taken;
}

void Arena::giveBack(const Scope::Place& begin) {
  end_ = begin;
  if (end_.total == 0 && pieces_.size() > 1) {
    pieces_.clear();
    end_ = {};
  }
}

std::size_t Arena::capacity() const {
  std::size_t bytes = 0;
  for (const Piece& piece : pieces_) bytes += piece.bytes;
  return bytes;
}

}  // namespace pomona
