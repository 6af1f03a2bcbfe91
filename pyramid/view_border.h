// Surfaces at the border of what both cameras see, and the holes beyond, which only the left one does.
#pragma once

#include <cstdint>

#include "core/arena.h"
#include "core/image.h"

namespace pomona {

/// A row's outermost source (see holes.h), if its match lies in the right view's outermost column. The holes
/// beyond it are there because the view ends: nothing says that the surface ends there, too, and another one
/// would have to begin in that very column by chance. So they are taken to continue it.
class ViewBorder {
 public:
  struct Source {
    int x;
    float disparity;
  };
  struct Ends {
    Source left, right;  ///< without one: before the first column, behind the last
  };

  /// The result lies in the current scope of `arena`.
  void find(ImageView<const float> disparity, ImageView<const std::uint8_t> state, Arena& arena, int threads);

  /// Sources that pixels farther left and farther right in row y lie beyond.
  const Ends& ends(int y) const { return ends_[y]; }

 private:
  Ends* ends_ = nullptr;  // of each row
};

}  // namespace pomona
