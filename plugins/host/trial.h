// Trying in a copy of the process what may end it.
#pragma once

#include <functional>
#include <string>

namespace pomona {

/// Forks, calls `work` in the child, which then leaves without running what a program runs as it ends, and
/// says how the child died, e.g. "by an exception: no luck" or "by signal 11 (Segmentation fault)". Empty if
/// it lived through `work`, whether that returned or threw; so it is if there can be no child, or if it takes
/// more than ten seconds. The child prints nothing. Memory is shared until it is written to, so that this
/// takes milliseconds even in a large process.
std::string deathBy(const std::function<void()>& work);

}  // namespace pomona
