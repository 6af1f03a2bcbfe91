// The figures of all methods on all scenes: as tables to read, and as JSON to compare with later.
#pragma once

#include <string>
#include <vector>

#include "bench/accuracy/figures.h"

namespace pomona {

/// Markdown: the means of all methods, then the main figures scene by scene.
std::string markdown(const std::vector<MethodFigures>& methods);

/// {"scenes": [...], "methods": {name: {"mean": {"all": {...}, "nonoccluded": {...}}, scene: {...}, ...}}};
/// figures that are not to be had are left out.
std::string json(const std::vector<MethodFigures>& methods);

/// An earlier json(), to a millionth. Throws std::runtime_error naming the file if it cannot be
/// read.
std::vector<MethodFigures> readFigures(const std::string& path);

}  // namespace pomona
