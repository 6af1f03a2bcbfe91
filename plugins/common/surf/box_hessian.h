// Second derivatives of the image by box filters, and the determinant of their matrix (section 3.2 of the
// paper).
#pragma once

#include <cstdint>
#include <vector>

#include "plugins/common/surf/integral_image.h"

namespace pomona {

/// Three lobes side by side approximate the second derivative of a Gaussian; the 9x9 filter, whose lobes are
/// 3 px wide, that of sigma = 1.2 px.
struct BoxFilter {
  int lobe_px;  ///< odd

  int size() const { return 3 * lobe_px; }
  int radius() const { return size() / 2; }
};

/// The scale (sigma in px) whose derivatives a filter of this size approximates.
inline float scaleOfSize(float size_px) {
  return size_px * (1.2f / 9);
}

/// Filters grow by 6 px from layer to layer in the first octave, by 12 in the second, by 24 in the third.
inline BoxFilter filterOf(int octave, int layer) {
  return {(2 << octave) * (layer + 1) + 1};
}

/// Computes determinants row by row; an object serves one thread.
class BoxHessian {
 public:
  explicit BoxHessian(const IntegralImage& image);

  /// `out[k] = Dxx Dyy - (0.9 Dxy)^2` at the pixel (k step, y) for all of them in the image, the derivatives
  /// divided by the area of the filter; 0 where the filter does not fit into the image.
  void determinants(BoxFilter filter, int y, int step, float* out);

  /// Whether Dxx + Dyy > 0, that is, whether the blob is darker than what surrounds it. The filter must fit
  /// there.
  bool isDark(BoxFilter filter, int x, int y);

 private:
  struct Derivatives {
    int xx, yy, xy;
  };
  void sumRows(BoxFilter filter, int y, int begin, int end);
  Derivatives derivatives(BoxFilter filter, int x) const;

  const IntegralImage& image_;
  // The filters are sums over columns of sums over rows; these are the latter, one per column of the integral
  // image.
  std::vector<std::uint32_t> band_xx_, band_yy_, band_xy_;
};

}  // namespace pomona
