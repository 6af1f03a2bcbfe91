// What SURF looks for, and what it writes down of it.
#pragma once

#include <string>

namespace pomona {

struct SurfOptions {
  /// The least determinant of the Hessian that makes an interest point, > 0. For gray values of 0 to 255 and
  /// filters divided by their whole area (the paper's normalisation): 30 keeps what stands out, 5 nearly
  /// everything above the noise of a camera. OpenCV's own SURF divides each lobe by the area of that lobe
  /// alone, so that its figures are (81 / 15)^2 = 29 times as large.
  float hessian_threshold = 30;
  /// 1 to 5. Each doubles the scales that are found and the step at which they are sampled, which is 1 px in
  /// the first.
  int octaves = 4;
  /// Filter sizes per octave, 3 to 5. Points are found in all but the smallest and the largest of them.
  int layers = 4;
  /// 128 values per descriptor in place of 64: better told apart, slower to match.
  bool extended = false;
  /// Leaves out the orientation (U-SURF): quicker, and better told apart, for cameras that stay level.
  bool upright = false;
  /// 0: as many as there are processors. The result does not depend on it.
  int threads = 0;

  /// Empty, or what is wrong: field, value, what is allowed.
  std::string problem() const;
};

}  // namespace pomona
