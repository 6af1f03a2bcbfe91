// A plugin's points on pairs with known disparities, beside those of plain SIFT and the dense map.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "bench/sparse/pairs.h"

namespace pomona {

/// A row for each pair, and their sum. `plugin`: one that has a parameter set "faithful" and a figure
/// "features left". `repetitions`: of what is timed; the median counts.
void writePointComparison(std::ostream& out, const std::string& plugin, const std::vector<TruthPair>& pairs,
                          int repetitions);

}  // namespace pomona
