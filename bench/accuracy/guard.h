// Keeps accuracy from slipping away unnoticed.
#pragma once

#include <string>
#include <vector>

#include "bench/accuracy/methods.h"
#include "bench/accuracy/report.h"

namespace pomona {

/// What is worse than it may be, one line each; empty if all is well. Means over the scenes in `found`, which
/// may be some or all of the accepted ones, are held against
/// - the accepted figures, over all and over the non-occluded pixels: bad-1 and bad-2 (of sparse maps:
/// wrong-1 and wrong-2) may rise, and coverage fall,
///   by 0.15 points at most, which leaves room for another compiler's rounding, and for nothing else;
/// - the peer's map of the same kind, where Contender::must_match_peer asks for it: the error figures over
/// all pixels
///   may not exceed its.
/// OpenCV's own figures are not guarded, nor is a method that was run on no scene. A scene without accepted
/// figures counts as a failure. `found` has one entry per contender.
std::vector<std::string> accuracyFailures(const std::vector<Contender>& contenders,
                                          const std::vector<MethodFigures>& found,
                                          const std::vector<MethodFigures>& accepted);

}  // namespace pomona
