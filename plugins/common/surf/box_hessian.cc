#include "plugins/common/surf/box_hessian.h"

#include <algorithm>

namespace pomona {

BoxHessian::BoxHessian(const IntegralImage& image) : image_(image) {
  for (auto* band : {&band_xx_, &band_yy_, &band_xy_})
    band->resize(static_cast<std::size_t>(image.width()) + 1);
}

// Columns [begin, end) of the integral image. Dyy is a box of three lobes minus three times its middle lobe;
// Dxy the lower boxes minus the upper ones.
void BoxHessian::sumRows(BoxFilter filter, int y, int begin, int end) {
  const int lobe = filter.lobe_px, radius = filter.radius(), half = lobe / 2, across = lobe - 1;
  const std::uint32_t *xx0 = image_.row(y - across), *xx1 = image_.row(y + across + 1);
  const std::uint32_t *yy0 = image_.row(y - radius), *yy1 = image_.row(y - half),
                      *yy2 = image_.row(y + half + 1), *yy3 = image_.row(y + radius + 1);
  const std::uint32_t *xy0 = image_.row(y - lobe), *xy1 = image_.row(y), *xy2 = image_.row(y + 1),
                      *xy3 = image_.row(y + lobe + 1);
  for (int x = begin; x < end; ++x) {
    band_xx_[x] = xx1[x] - xx0[x];
    band_yy_[x] = yy3[x] - yy0[x] - 3 * (yy2[x] - yy1[x]);
    band_xy_[x] = xy3[x] - xy2[x] - (xy1[x] - xy0[x]);
  }
}

inline BoxHessian::Derivatives BoxHessian::derivatives(BoxFilter filter, int x) const {
  const int lobe = filter.lobe_px, radius = filter.radius(), half = lobe / 2, across = lobe - 1;
  const std::uint32_t *xx = band_xx_.data() + x, *yy = band_yy_.data() + x, *xy = band_xy_.data() + x;
  return {static_cast<int>(xx[radius + 1] - xx[-radius] - 3 * (xx[half + 1] - xx[-half])),
          static_cast<int>(yy[across + 1] - yy[-across]),
          static_cast<int>(xy[lobe + 1] - xy[1] - (xy[0] - xy[-lobe]))};
}

void BoxHessian::determinants(BoxFilter filter, int y, int step, float* out) {
  const int width = image_.width(), radius = filter.radius(), columns = (width - 1) / step + 1;
  const int begin = (radius + step - 1) / step, end = (width - 1 - radius) / step + 1;
  if (y < radius || y + radius >= image_.height() || width < filter.size() || begin >= end) {
    std::fill_n(out, columns, 0.0f);
    return;
  }
  std::fill_n(out, begin, 0.0f);
  std::fill(out + end, out + columns, 0.0f);
  sumRows(filter, y, begin * step - radius, (end - 1) * step + radius + 2);
  const float scale = 1.0f / static_cast<float>(filter.size() * filter.size());
  const auto fill = [&](int stride) {
    for (int k = begin; k < end; ++k) {
      const Derivatives d = derivatives(filter, k * stride);
      const float xx = scale * static_cast<float>(d.xx), yy = scale * static_cast<float>(d.yy);
      const float xy = scale * static_cast<float>(d.xy);
      out[k] = xx * yy - 0.81f * xy * xy;
    }
  };
  if (step == 1)
    fill(1);  // a stride that the compiler knows lets it use vectors; this is the octave with nearly all of
              // the work
  else
    fill(step);
}

bool BoxHessian::isDark(BoxFilter filter, int x, int y) {
  sumRows(filter, y, x - filter.radius(), x + filter.radius() + 2);
  const Derivatives d = derivatives(filter, x);
  return d.xx + d.yy > 0;
}

}  // namespace pomona
