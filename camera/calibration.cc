#include "pomona/calibration.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace pomona {
namespace {

template <typename Number>
void require(bool good, const char* field, Number value, const char* allowed) {
  if (good) return;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << field << " is " << value << "; allowed: " << allowed;
  throw std::invalid_argument(message.str());
}

}  // namespace

void StereoCalibration::validate() const {
  require(std::isfinite(focal_px) && focal_px > 0, "focal_px", focal_px, "a finite number above 0");
  require(std::isfinite(cx_px), "cx_px", cx_px, "a finite number");
  require(std::isfinite(cy_px), "cy_px", cy_px, "a finite number");
  require(std::isfinite(baseline_m) && baseline_m > 0, "baseline_m", baseline_m, "a finite number above 0");
  require(std::isfinite(doffs_px), "doffs_px", doffs_px, "a finite number");
  require(width >= 0, "width", width, "0 (unknown) or more");
  require(height >= 0, "height", height, "0 (unknown) or more");
  require((width > 0) == (height > 0), "height", height, "above 0 if width is, 0 (unknown) if width is 0");
  require(num_disparities >= 0, "num_disparities", num_disparities, "0 (unknown) or more");
}

}  // namespace pomona
