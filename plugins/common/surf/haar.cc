#include "plugins/common/surf/haar.h"

#include <algorithm>

namespace pomona {
namespace {

/// A place on an axis of the integral image: between `cell` and `cell + 1`, `part` sixteenths from the
/// former.
struct Place {
  int cell;
  std::uint32_t part;

  Place(int fixed, int cells)
      : cell(std::min(fixed / kFixedOne, cells - 1)), part(fixed - kFixedOne * cell) {}
};

/// 256 times the sum of all pixels above and left of a place, linear between the entries of the table:
/// exactly what pixels that count by the share inside add up to.
struct Row {
  const std::uint32_t *upper, *lower;
  std::uint32_t part;

  Row(const IntegralImage& image, const Place& y)
      : upper(image.row(y.cell)), lower(image.row(y.cell + 1)), part(y.part) {}

  std::uint32_t operator()(const Place& x) const {
    const std::uint32_t a = upper[x.cell], b = upper[x.cell + 1], c = lower[x.cell], d = lower[x.cell + 1];
    const std::uint32_t top = kFixedOne * a + x.part * (b - a), bottom = kFixedOne * c + x.part * (d - c);
    return kFixedOne * top + part * (bottom - top);
  }
};

}  // namespace

HaarResponse haarResponse(const IntegralImage& image, int x, int y, int half) {
  x += kFixedOne / 2;  // the centre of pixel 0 is half a pixel from the origin of the integral image
  y += kFixedOne / 2;
  if (x < half || y < half || x + half > kFixedOne * image.width() || y + half > kFixedOne * image.height())
    return {0, 0};
  const Place left(x - half, image.width()), middle(x, image.width()), right(x + half, image.width());
  const Row upper(image, Place(y - half, image.height())), centre(image, Place(y, image.height())),
      lower(image, Place(y + half, image.height()));
  const std::uint32_t a = upper(left), b = upper(middle), c = upper(right);
  const std::uint32_t d = centre(left), e = centre(right);
  const std::uint32_t f = lower(left), g = lower(middle), h = lower(right);
  return {static_cast<float>(static_cast<std::int32_t>((h - 2 * g + f) - (c - 2 * b + a))),
          static_cast<float>(static_cast<std::int32_t>((h - 2 * e + c) - (f - 2 * d + a)))};
}

}  // namespace pomona
