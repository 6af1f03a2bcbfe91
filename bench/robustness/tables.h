// The figures of all methods on all scenes, once for each change of the right view.
#pragma once

#include <string>
#include <vector>

#include "bench/accuracy/figures.h"

namespace pomona {

struct ChangedFigures {
  std::string change;
  std::vector<MethodFigures> methods;  ///< the same methods and scenes for each change
};

/// Markdown: bad-1 and bad-2 for each change, and by how much they rose over the first, which is none. All
/// methods are held against the last one, the peer.
std::string robustnessMarkdown(const std::vector<ChangedFigures>& all);

/// {change: the json() of its methods, ...}
std::string robustnessJson(const std::vector<ChangedFigures>& all);

}  // namespace pomona
