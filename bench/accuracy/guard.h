// Keeps accuracy from slipping away unnoticed.
#pragma once

#include <string>
#include <vector>

#include "bench/accuracy/methods.h"
#include "bench/accuracy/report.h"

namespace pomona {

/// What is worse than it may be, one line each; empty if all is well. Means over all pixels are held against
/// - the accepted figures: dense bad-1 and bad-2, sparse wrong-1 and wrong-2 may rise, and sparse coverage
/// fall, by
///   0.15 points at most, which leaves room for another compiler's or OpenCV's rounding, and for nothing
///   else;
/// - the peer of the same kind, where Method::must_match_peer asks for it: the error figures may not exceed
/// its. Figures of other scenes than the accepted ones cannot be compared, and count as a failure.
std::vector<std::string> accuracyFailures(const std::vector<Method>& methods,
                                          const std::vector<MethodFigures>& found,
                                          const AcceptedFigures& accepted);

}  // namespace pomona
