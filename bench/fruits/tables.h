// The tables of what was measured.
#pragma once

#include <span>
#include <string>

#include "bench/fruits/fruit_list.h"

namespace pomona {

/// Markdown: all methods with masks; their medians; the other regions and the centre for those that know
/// sigma.
std::string fruitTables(std::span<const FruitMethod> methods);

}  // namespace pomona
