// Which disparities a verb searches.
#pragma once

#include <optional>
#include <string>

#include "apps/compute_files.h"
#include "pomona/options.h"

namespace pomona {

struct SearchRange {
  int min = 0;
  int count = 0;
  std::string source;  ///< where the upper end comes from
};

/// From `min` up to below `max`, else the calibration's ndisp, else an estimate, for which `options`' threads
/// and isa count. Throws std::invalid_argument for a range that cannot be searched.
SearchRange searchRange(const ComputePaths& paths, const ComputeInputs& inputs, int min,
                        std::optional<int> max, const Options& options);

}  // namespace pomona
