#include "baselines/window_products.h"

namespace pomona {
namespace {

/// out[x] = the sum of columns[x] to columns[x + side - 1].
template <typename Sum>
void slideWindow(const std::vector<Sum>& columns, int side, int width, Sum* out) {
  Sum window = 0;
  for (int u = 0; u < side - 1; ++u) window += columns[static_cast<std::size_t>(u)];
  for (int x = 0; x < width; ++x) {
    window += columns[static_cast<std::size_t>(x + side - 1)];
    out[x] = window;
    window -= columns[static_cast<std::size_t>(x)];
  }
}

}  // namespace

template <typename T>
WindowMoments<T>::WindowMoments(const PixelView<T>& view, int radius)
    : sum(static_cast<std::size_t>(view.channels)) {
  using Sum = WindowSum<T>;
  for (Image<Sum>& plane : sum) plane.resize(view.width, view.height);
  squares.resize(view.width, view.height);
  const int side = 2 * radius + 1, columns = view.width + 2 * radius;
  std::vector<Sum> value_sums(static_cast<std::size_t>(columns)), square_sums(value_sums.size());
  for (int y = 0; y < view.height; ++y) {
    std::fill(square_sums.begin(), square_sums.end(), Sum{0});
    for (int c = 0; c < view.channels; ++c) {
      std::fill(value_sums.begin(), value_sums.end(), Sum{0});
      for (int v = -radius; v <= radius; ++v)
        for (int u = 0; u < columns; ++u) {
          const Sum value = view.nearest(y + v, u - radius)[c];
          value_sums[static_cast<std::size_t>(u)] += value;
          square_sums[static_cast<std::size_t>(u)] += value * value;
        }
      slideWindow(value_sums, side, view.width, sum[static_cast<std::size_t>(c)].row(y));
    }
    slideWindow(square_sums, side, view.width, squares.row(y));
  }
}

template <typename T>
WindowProducts<T>::WindowProducts(const PixelView<T>& left, const PixelView<T>& right, int radius,
                                  SearchRange range, int first_row)
    : left_(left),
      right_(right),
      radius_(radius),
      range_(range),
      y_(first_row),
      columns_(static_cast<std::size_t>(left.width + 2 * radius) * static_cast<std::size_t>(range.count)),
      window_(static_cast<std::size_t>(range.count)),
      mirrored_(static_cast<std::size_t>(left.width + 2 * radius + range.count - 1)) {
  for (int y = first_row - radius - 1; y < first_row + radius; ++y) accumulate<true>(y);
}

template <typename T>
void WindowProducts<T>::advance() {
  accumulate<false>(y_ - radius_ - 1);
  accumulate<true>(y_ + radius_);
  ++y_;
}

template <typename T>
template <bool kAdd>
void WindowProducts<T>::accumulate(int y) {
  const int columns = left_.width + 2 * radius_;
  // The right column that the last left one meets at the smallest disparity: the largest of all.
  const int last = columns - 1 - radius_ - range_.min;
  for (int c = 0; c < left_.channels; ++c) {
    for (std::size_t k = 0; k < mirrored_.size(); ++k)
      mirrored_[k] = right_.nearest(y, last - static_cast<int>(k))[c];
    for (int u = 0; u < columns; ++u) {
      const Sum value = left_.nearest(y, u - radius_)[c];
      const Sum* match = mirrored_.data() + (columns - 1 - u);
      Sum* sums = column(u);
      for (int i = 0; i < range_.count; ++i) sums[i] += kAdd ? value * match[i] : -(value * match[i]);
    }
  }
}

template struct WindowMoments<std::uint8_t>;
template struct WindowMoments<std::uint16_t>;
template class WindowProducts<std::uint8_t>;
template class WindowProducts<std::uint16_t>;

}  // namespace pomona
