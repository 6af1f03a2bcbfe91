#include "baselines/window_products.h"

namespace pomona {

template <typename T>
WindowMoments<T>::WindowMoments(const PixelView<T>& view, int radius, int threads)
    : sum(static_cast<std::size_t>(view.channels)) {
  using Sum = WindowSum<T>;
  for (Image<Sum>& plane : sum) plane.resize(view.width, view.height);
  squares.resize(view.width, view.height);
  parallelStrips(threads, view.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < view.width; ++x) {
        Sum all_squares = 0;
        for (int c = 0; c < view.channels; ++c) {
          Sum total = 0;
          for (int v = -radius; v <= radius; ++v)
            for (int u = -radius; u <= radius; ++u) {
              const Sum value = view.nearest(y + v, x + u)[c];
              total += value;
              all_squares += value * value;
            }
          sum[static_cast<std::size_t>(c)].row(y)[x] = total;
        }
        squares.row(y)[x] = all_squares;
      }
  });
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
