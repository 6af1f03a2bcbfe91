#include "apps/search_range.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "pomona/engine.h"
#include "sgm/kernels.h"

namespace pomona {

SearchRange searchRange(const ComputePaths& paths, const ComputeInputs& inputs, int min,
                        std::optional<int> max, const Options& options) {
  const int width = inputs.left.cols;
  const int ndisp = inputs.calibration ? inputs.calibration->num_disparities : 0;
  SearchRange range{min, 0, ""};
  std::int64_t count = 0;
  if (max) {
    range.source = "--max-disparity";
    count = std::int64_t{*max} - range.min;
  } else if (ndisp > 0) {
    range.source = "ndisp of " + paths.calibration + paths.rig;
    count = std::int64_t{ndisp} - range.min;
  } else {
    range.source = "estimate";
    Options from_min = options;
    from_min.min_disparity = range.min;
    count = estimateNumDisparities(inputs.left, inputs.right, from_min, inputs.mask);
  }
  const int most = std::min(kMaxDisparities, width);
  if (count < 1 || count > most)
    throw std::invalid_argument(range.source + ": the range from --min-disparity " +
                                std::to_string(range.min) + " to below " + std::to_string(range.min + count) +
                                " holds " + std::to_string(count) + " disparities; allowed: 1 to " +
                                std::to_string(most) + " (the image is " + std::to_string(width) + " wide)");
  range.count = static_cast<int>(count);
  return range;
}

}  // namespace pomona
